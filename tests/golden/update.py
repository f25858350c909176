"""Make the golden files again through the command line: `python -m tests.golden.update`."""

import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

GOLDEN = Path(__file__).parent
EXAMPLES = GOLDEN.parents[1] / "examples"
STORED = ("*.design.json", "*.profile.json")
"""Designs that a build keeps where a fresh one agrees."""

NAMES = sorted(path.stem for path in EXAMPLES.glob("*.toml"))


def run(*arguments: str) -> None:
    """Run the program."""
    command = [sys.executable, "-m", "swayless", *arguments]
    subprocess.run(command, check=True, capture_output=True, cwd=EXAMPLES)


def built(
    name: str, folder: Path, *, stored: Path | None = None, build: Callable[..., None] = run
) -> dict[str, bytes]:
    """Build an example into a folder, beside a stored design if there is one; everything but the figures."""
    folder.mkdir(parents=True)
    for design in (path for ending in STORED for path in stored.glob(ending)) if stored else ():
        shutil.copy(design, folder)
    build("build", f"{name}.toml", "-o", str(folder), "--no-verify")
    return files_below(folder)


def files_below(folder: Path) -> dict[str, bytes]:
    """Contents of all files but figures, by relative path."""
    paths = (path for path in sorted(folder.rglob("*")) if path.is_file())
    found = {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}
    return {path: content for path, content in found.items() if not path.startswith("figures/")}


def main() -> None:
    """Write the golden files of every example; stored designs are kept where they agree with fresh ones."""
    for name in NAMES:
        target = GOLDEN / name
        with tempfile.TemporaryDirectory() as folder:
            files = built(name, Path(folder) / name, stored=target if target.exists() else None)
        shutil.rmtree(target, ignore_errors=True)
        for path, content in files.items():
            (target / path).parent.mkdir(parents=True, exist_ok=True)
            (target / path).write_bytes(content)
        print(f"{name}: {len(files)} files")


if __name__ == "__main__":
    main()
