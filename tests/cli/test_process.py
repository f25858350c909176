"""The program as a process: terminals, pipes and interruptions."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.cli.conftest import snapshot

PROGRAM = [sys.executable, "-m", "swayless"]


def on_terminal(*arguments: object, folder: Path, columns: int = 80) -> tuple[int, str]:
    """Run the program with a pseudo-terminal as every stream; its exit code and what the terminal got."""
    pty = pytest.importorskip("pty", reason="pseudo-terminals are a thing of Unix")
    control, terminal = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": str(columns)}
    streams = {"stdin": terminal, "stdout": terminal, "stderr": terminal}
    with subprocess.Popen(
        [*PROGRAM, *map(str, arguments)], cwd=folder, env=environment, **streams
    ) as process:
        os.close(terminal)
        got = b""
        while True:
            try:
                part = os.read(control, 65536)
            except OSError:  # Linux says so when the last one has closed the terminal
                break
            if not part:
                break
            got += part
    os.close(control)
    return process.returncode, got.decode()


def test_progress_shows_on_a_terminal_and_tables_fit_it(gantry, tmp_path):
    code, got = on_terminal("build", gantry.name, "--no-verify", folder=tmp_path)
    assert code == 0
    for work in ("designing long ...", "designing short ...", "drawing figures ..."):
        assert work in got
    table = got.rpartition("\x1b[2K")[2].replace("\x1b[1m", "").replace("\x1b[0m", "").splitlines()
    assert any("6.931 to 7.739" in line for line in table)
    assert max(map(len, table)) <= 80


def test_progress_stays_out_of_files_and_pipes(arm, tmp_path):
    command = [*PROGRAM, "build", arm, "-o", tmp_path / "out", "--check"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (1, "")
    assert "\x1b" not in done.stdout
    assert "designing" not in done.stdout


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("arguments", [("--help",), ("design", "zv", "--frequency", "1")])
def test_a_reader_who_leaves_early_gets_no_traceback(arguments, unbuffered):
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}
    with subprocess.Popen([*PROGRAM, *arguments], env=environment, **streams) as process:
        process.stdout.close()
        error = process.stderr.read().decode()
    assert error == ""


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="/dev/full is a thing of Linux")
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_an_output_that_takes_nothing_is_an_error_without_traceback(unbuffered):
    command = [*PROGRAM, "design", "zv", "--frequency", "1"]
    environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered}
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, env=environment, check=False)
    assert done.returncode == 2
    assert done.stderr.decode() == "error: [Errno 28] No space left on device\n"


@pytest.fixture
def interruptible():
    """Shells let what runs in the background ignore interrupts, and children inherit that: not here."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows interrupts by other means")
@pytest.mark.usefixtures("interruptible")
def test_an_interrupted_build_leaves_nothing_behind(arm, tmp_path):
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    before = snapshot(tmp_path)
    environment = {**os.environ, "TMPDIR": str(temporary)}
    command = [*PROGRAM, "build", arm, "-o", tmp_path / "out"]
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=environment,
    ) as process:
        deadline = time.monotonic() + 60.0
        while not list(temporary.iterdir()) and time.monotonic() < deadline:  # until it compiles
            time.sleep(0.01)
        assert process.poll() is None
        process.send_signal(signal.SIGINT)
        out, error = process.communicate(timeout=60.0)
    assert process.returncode == 130
    assert (out, error) == (b"", b"")
    assert snapshot(tmp_path) == before


def test_text_without_box_characters_for_an_output_in_ascii():
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    command = [*PROGRAM, "design", "zv", "--frequency", "1"]
    done = subprocess.run(command, capture_output=True, env=environment, check=True)
    assert b"time [s]" in done.stdout
    assert done.stdout.isascii()
