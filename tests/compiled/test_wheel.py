"""The wheel carries its templates and examples: built, installed in a fresh environment, and used there."""

import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_a_fresh_environment_generates_from_the_wheel(tmp_path):
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    subprocess.run([*pip, "wheel", "--no-deps", "--wheel-dir", tmp_path, ROOT], check=True)
    (wheel,) = tmp_path.glob("swayless-*.whl")
    venv.create(tmp_path / "env", with_pip=True)
    scripts = tmp_path / "env" / ("Scripts" if sys.platform == "win32" else "bin")
    subprocess.run([scripts / "python", "-m", "pip", "install", "--quiet", wheel], check=True)
    swayless = scripts / "swayless"
    subprocess.run([swayless, "init", "gantry.toml"], check=True, cwd=tmp_path)
    subprocess.run([swayless, "build", "gantry.toml", "-o", "made", "--no-verify"], check=True, cwd=tmp_path)
    made = {
        path.relative_to(tmp_path / "made").as_posix()
        for path in (tmp_path / "made").rglob("*")
        if path.is_file()
    }
    assert {"srtc_gantry.design.json", "c/srtc_gantry_shaper.c", "st/FB_srtc_gantry_Shaper.st"} <= made
    source = "c/srtc_gantry_shaper.c"
    text = (tmp_path / "made" / source).read_text()
    golden = (ROOT / "tests" / "golden" / "srtc-gantry" / source).read_text()
    tables = "static const uint32_t srtc_gantry_DELAY_TICKS"
    assert text[text.index(tables) :] == golden[golden.index(tables) :]
