"""The wheel carries its templates and examples: built, installed by itself, and used there.

What it depends on comes from the environment of the tests, which its own metadata has installed.
"""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_an_installed_wheel_generates_without_the_checkout(tmp_path):
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    subprocess.run([*pip, "wheel", "--no-deps", "--wheel-dir", tmp_path, ROOT], check=True)
    (wheel,) = tmp_path.glob("swayless-*.whl")
    installed = tmp_path / "installed"
    subprocess.run([*pip, "install", "--no-deps", "--target", installed, wheel], check=True)
    environment = {**os.environ, "PYTHONPATH": str(installed)}

    def run(*command):
        done = subprocess.run(
            command, check=True, cwd=tmp_path, env=environment, capture_output=True, text=True
        )
        return done.stdout

    found = run(sys.executable, "-c", "import swayless; print(swayless.__file__)")
    assert Path(found.strip()).is_relative_to(installed)
    (swayless,) = (path for path in (installed / "bin").iterdir() if path.stem == "swayless")
    run(swayless, "init", "gantry.toml")
    run(swayless, "build", "gantry.toml", "-o", "made", "--no-verify")
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
