"""Wrong input: a message that says what to do, on standard error, exit code 2, and nothing written."""

from __future__ import annotations

import shutil

import pytest

from tests.cli.conftest import snapshot

DESIGN = [
    ("design zv", "--frequency, --period, --rope-length: exactly one of them is needed, none is given"),
    ("design zv --frequency 1 --period 1", "needed, --frequency and --period are given"),
    ("design zvv --frequency 1", 'FAMILY = "zvv": unknown family; nearest: zv,'),
    ("design bnk crane.toml", "unexpected extra argument"),
    ("design bnk", 'FAMILY = "bnk": unknown family; nearest: bank; known: zv,'),
    ("design recomend", 'FAMILY = "recomend": unknown family; nearest: recommend; known: zv,'),
    ("design FAMILY --frequency 1", 'FAMILY = "FAMILY": unknown family; known: zv,'),
    ("design --frequency 1", "Missing argument 'FAMILY'"),
    ("design --tick 1 si", 'FAMILY = "si": is a command of its own, and stands first: swayless design si'),
    ("design zv --frequency 1 --contactor", "a contactor drive gives 0 or full speed: allowed are um-zv"),
    ("design zv --frequency -1", "--frequency = -1: must be > 0"),
    ("design zv --frequency 0", "--frequency = 0: must be > 0"),
    ("design zv --frequency nan", "--frequency = nan: is not a finite number"),
    ("design zv --frequency inf", "--frequency = inf: is not a finite number"),
    ("design zv --frequency 1e300", "--frequency = 1e+300: must be at least 0.001 and at most 10000 Hz"),
    (
        "design zv --frequency 3kg",
        '--frequency = "3kg": is not a frequency: allowed units are Hz, mHz, kHz, rpm',
    ),
    ("design zv --period 0", "--period = 0: must be > 0"),
    ("design zv --period 1 --damping 1", "--damping = 1: must be at least 0 and below 1"),
    ("design zv --rope-length -2", "--rope-length = -2: must be > 0"),
    ("design ei --frequency 1 --tolerance 0", "--tolerance = 0: must be > 0"),
    ("design ei --frequency 1 --tolerance 1", "--tolerance = 1: must be at least 1e-06 and below 1"),
    ("design ei --frequency 1 --tolerance 2", "--tolerance = 2: must be at least 1e-06 and below 1"),
    ("design ei3 --frequency 1 --damping 0.5", "ei3 at tolerance 0.05 exists up to damping_ratio 0.27"),
    ("design zvm --frequency 1", '--order: missing: family "zvm" needs it'),
    ("design zvm --frequency 1 --order x", '--order = "x": must be an integer from 0 to 18'),
    ("design zv --frequency 1 --order 2", '--order = 2: family "zv" takes none; only zvm does'),
    ("design oatf --frequency 1 --delay 0", "--delay = 0: must be > 0"),
    ("design zv --frequency 1 --tick 2", "--tick = 2: must be at least 1e-06 and at most 1 s"),
    ("design zv --frequency 4.5 --tick 0.5", "a tick of "),
    ("design zv --frequency 1 --max-speed 0", "--max-speed = 0: must be > 0"),
    ("design zv --frequency 1 --acceleration -1", "--acceleration = -1: must be > 0"),
    (
        "design zv --frequency 1 --number int32",
        '--counts-per-m-s: missing: number = "int32" computes in counts',
    ),
    ("design zv --frequency 1 --counts-per-m-s nan", "--counts-per-m-s = nan: must be a number from"),
    ("design zv --frequency 1 --number int32 --counts-per-m-s 1e11", "int32 allows 1 to 268435456"),
    ("design zv --frequency 1 --number int64", "--number"),
    (
        "design zv --frequency 1 --name int",
        'is a reserved word of C, C++ or Structured Text; for instance "int_crane"',
    ),
    ("design zv --frequency 1 --name lreal", "is a reserved word"),
    ("design zv --frequency 1 --name A-b", "must be lower-case letters, digits and underscores"),
    ("design zv --frequency 1 -o folder", "folder: cannot be written: it is a directory"),
    ("design zv --frequency 1 -o no/a.json", "no/a.json: cannot be written: there is no folder no"),
    ("design zv --frequency 1 -o empty.json/a.json", "cannot be written"),
]
ROBUST = [
    ("design si", "--band, --rope-length: exactly one of them is needed, none is given"),
    ("design si --band 1 2 --rope-length 1 2", "is needed, --band and --rope-length are given"),
    ("design si --band", "--band"),
    ("design si --band 1", "--band = 1: must be an array of two values, the ends of a range"),
    ("design si --band 1 2 3", "--band = [1, 2, 3]: must be an array of two values"),
    ("design si --band 1 1", "--band = [1, 1]: must be two different values, the ends of a range"),
    ("design si --band 0 1", "--band[0] = 0: must be > 0"),
    ("design si --band -1 2", "--band[0] = -1: must be > 0"),
    ("design si --band 1 -2", "--band[1] = -2: must be > 0"),
    ("design si --band 1 nan", "--band[1] = nan: is not a finite number"),
    ("design si --band 1 1e300", "--band[1] = 1e+300: must be at least 0.001 and at most 10000 Hz"),
    ("design si --band 1 2kg", '--band[1] = "2kg": is not a frequency: allowed units are Hz'),
    ("design si --band 1 2 --band 3 x", '--band[1][1] = "x": is not a frequency'),
    ("design si --band 0.1 9", "the ratio 90 must be at most 8"),
    ("design si --rope-length 9ft 9000kg", '--rope-length[1] = "9000kg": is not a length'),
    ("design si --rope-length 0 2", "--rope-length[0] = 0: must be > 0"),
    ("design si --band 1 2 --damping 0.3", "--damping = 0.3: must be at least 0 and at most 0.2"),
    ("design si --band 1 2 --damping 0 2", "--damping[1] = 2: must be at least 0 and at most 0.2"),
    ("design si --band 1 2 --damping 0 1 2", "--damping = [0, 1, 2]: must be one value or an array of two"),
    ("design si --band 1 2 --tolerance 0.5", "--tolerance = 0.5: must be at least 0.01 and at most 0.2"),
    ("design si --band 1 2 --tolerance 5", "--tolerance = 5: must be at least 0.01 and at most 0.2"),
    ("design si --band 1 2 --amplitudes negative", "--amplitudes"),
    ("design si --band 1 2 --impulses 5", '--impulses = 5: only with amplitudes = "unity-magnitude"'),
    (
        "design si --band 1 2 --amplitudes unity-magnitude --impulses 4",
        "--impulses = 4: must be odd: +1, -1, ..., +1",
    ),
    (
        "design si --band 1 2 --amplitudes positive --contactor",
        '--amplitudes = "positive": a contactor drive gives 0 or full speed: must be "unity-magnitude"',
    ),
    ("design si --band 1 2 --contactor --acceleration 1", "--acceleration = 1: a contactor drive gives 0 or"),
    ("design si --band 1 2 --order 2", "--order"),
    ("design si 1 2", "unexpected extra argument"),
    ("design si --band 1 2 -o no/a.json", "no/a.json: cannot be written: there is no folder no"),
    ("design fd", "--duration"),
    ("design fd --duration 3", "--from"),
    (
        "design fd --duration 3 --from 29",
        '--from = "29": needs a unit: m, cm, mm, in, ft for the longest rope, Hz, mHz, kHz, rpm for the',
    ),
    ("design fd --duration 3 --from 29kg", '--from = "29kg": needs a unit'),
    ("design fd --duration 3 --from ft", '--from = "ft": is not a length'),
    ("design fd --duration 3 --from -29ft", '--from = "-29ft": must be > 0'),
    ("design fd --duration 0 --from 29ft", "--duration = 0: must be > 0"),
    ("design fd --duration 1 --from 29ft", "duration_s = 1.0: too short"),
    ("design fd --duration 3 --from 29ft --damping 0 0.05", "unexpected extra argument"),
]
FILES = [
    ("init arm.toml", "arm.toml: is there already; choose another name, or replace it with --force"),
    ("init folder --force", "folder: cannot be written: it is a directory"),
    ("init no/a.toml", "no/a.toml: cannot be written: there is no folder no"),
    ("init x.toml --example nope", "srtc-gantry"),
    ("build", "MACHINE.toml"),
    ("build a.toml b.toml", "b.toml"),
    ("build none.toml", "none.toml: cannot be read: there is no such file"),
    ("build folder", "folder: cannot be read: it is a directory"),
    (
        "build empty.toml",
        "is empty: a machine file needs name, [crane] or [arm], [controller] and at least one",
    ),
    ("build garbage.bin", "garbage.bin: is not UTF-8 text: byte 0xff in line 1"),
    ("build arm.toml -o empty.json", "empty.json: is a file, not a directory; choose another with -o"),
    ("build arm.toml -o empty.json/x", "empty.json: is a file, not a directory"),
    ("build arm.toml -o .", "arm.toml: is not a file that swayless makes here; move it away"),
    ("build arm.toml --check -o empty.json", "empty.json: is a file, not a directory"),
    ("build arm.toml --compiler tcc", "--compiler"),
    ("build arm.toml --soak-ticks -1", "--soak-ticks"),
    ("generate c", "FILE.json"),
    ("generate java taps.json -o made", "LANGUAGE"),
    ("generate c taps.json", "--output"),
    (
        "generate c plain.json -o made",
        "the design has no tick: design it with --tick, for instance --tick '10 ms'",
    ),
    ("generate c none.json -o made", "none.json: cannot be read: there is no such file"),
    (
        "generate c empty.json -o made",
        "empty.json: is empty: a design file is JSON that 'swayless design' or",
    ),
    ("generate c garbage.bin -o made", "garbage.bin: is not UTF-8 text"),
    ("generate c folder -o made", "folder: cannot be read: it is a directory"),
    ("generate c taps.json -o taps.json", "taps.json: is a file, not a directory"),
    ("generate c taps.json -o .", "arm.toml: is not a file that swayless makes here"),
    ("generate c taps.json -o made --number int32", "counts_per_m_s"),
    ("generate st counts.json -o made --number int32", "'int32'"),
    ("verify", "PATH"),
    ("verify none.json", "none.json: cannot be read: there is no such file"),
    ("verify plain.json", "the design has no tick"),
    (
        "verify folder",
        "folder: holds 0 files *.design.json, *.adaptive.json, *.profile.json; give a directory that",
    ),
    (
        "verify folder --number float",
        "--number: files in a directory have their number type; give a design file",
    ),
]
PLOT = [
    ("plot", "KIND"),
    ("plot pie taps.json -o a.svg", "KIND"),
    ("plot sensitivity taps.json", "--output"),
    (
        "plot sensitivity taps.json -o a.bmp",
        "a.bmp: suffix '.bmp' is no figure format: must be one of .svg, .png, .pdf",
    ),
    ("plot sensitivity taps.json -o folder", "no figure format"),
    ("plot sensitivity taps.json -o no/a.svg", "no/a.svg: cannot be written"),
    ("plot sensitivity none.json -o a.svg", "none.json: cannot be read: there is no such file"),
    (
        "plot sensitivity taps.json -o a.svg --span 2 1",
        "--span 2 1: must be the lower end, then the higher one",
    ),
    ("plot sensitivity taps.json -o a.svg --span 0 inf", "--span = inf: is not a finite number"),
    ("plot sensitivity taps.json -o a.svg --span 1kg 2", '--span = "1kg": is not a frequency'),
    (
        "plot sensitivity taps.json -o a.svg --row 2",
        "--row: belongs to plot response, not to plot sensitivity",
    ),
    ("plot response taps.json -o a.svg --row 9", "--row = 9: must be an integer from 1 to 1"),
    ("plot response taps.json -o a.svg --row 0", "--row = 0: must be an integer from 1 to 1"),
    ("plot response taps.json -o a.svg --press 0", "--press = 0: must be > 0"),
    (
        "plot response taps.json -o a.svg --press 1e9",
        "--press = 1000000000.0: must be at least 0.001 and at most",
    ),
    ("plot response taps.json plain.json -o a.svg", "plot response draws one design, 2 are given"),
    ("plot bank taps.json -o a.svg", "a bank figure needs a range"),
    (
        "plot bank taps.json -o a.svg --over rope-length",
        "--over: belongs to plot sensitivity, not to plot bank",
    ),
]


@pytest.fixture
def workplace(arm, designs, tmp_path):
    """A folder with good and bad files."""
    (tmp_path / "folder").mkdir()
    for name in ("empty.toml", "empty.json"):
        (tmp_path / name).touch()
    (tmp_path / "garbage.bin").write_bytes(b"\xff\xfe\x00garbage")
    shutil.copytree(designs, tmp_path, dirs_exist_ok=True)
    return tmp_path


CASES = [*DESIGN, *ROBUST, *FILES, *PLOT]


@pytest.mark.parametrize(("line", "message"), CASES, ids=[line for line, _ in CASES])
def test_wrong_input_is_refused_with_a_message_and_leaves_nothing_behind(run, workplace, line, message):
    before = snapshot(workplace)
    done = run(*line.split())
    assert message in done.err
    assert (done.code, done.out) == (2, "")
    assert "Traceback" not in done.err
    assert snapshot(workplace) == before


def test_all_that_is_wrong_with_the_options_is_said_at_once(run):
    done = run("design", "zv", "--frequency", -1, "--damping", 2, "--tick", 2, "--name", "int")
    lines = done.err.splitlines()
    assert [line.split()[1] for line in lines] == ["--frequency", "--damping", "--tick", "--name"]
    assert all(line.startswith("error: ") for line in lines)


def test_all_that_is_wrong_with_several_files_is_said_at_once(run, workplace):
    lines = run("plot", "sensitivity", "empty.json", "none.json", "folder", "-o", "a.svg").err.splitlines()
    assert [line.split()[1] for line in lines] == ["empty.json:", "none.json:", "folder:"]


BAD_MACHINES = {
    "a negative length": ('"9 ft"', '"-9 ft"', '[crane] rope_length[0] = "-9 ft": must be > 0'),
    "a zero length": ('"9 ft"', "0", "[crane] rope_length[0] = 0: must be > 0"),
    "an unknown key": ("acceleration", "accelleration", "accelleration: unknown key; nearest: acceleration"),
    "a wrong unit": (
        '"10 ms"',
        '"10 kg"',
        '[controller] tick = "10 kg": is not a time: allowed units are s, ms',
    ),
    "an infinite number": (
        "max_speed = 0.5",
        "max_speed = inf",
        "[crane] max_speed = inf: is not a finite number",
    ),
    "not a number": ("max_speed = 0.5", "max_speed = nan", "[crane] max_speed = nan: is not a finite number"),
    "a tick of 2 s": ('"10 ms"', "2", "[controller] tick = 2: must be at least 1e-06 and at most 1 s"),
    "a C keyword": ("srtc_gantry", "int", 'name = "int": is a reserved word of C, C++ or Structured Text'),
    "an ST keyword": (
        "srtc_gantry",
        "lreal",
        'name = "lreal": is a reserved word of C, C++ or Structured Text',
    ),
    "an unknown family": ("um-zv", "um-zw", 'family = "um-zw": unknown family; nearest: um-zv'),
    "a damping beyond the family's end": (
        '"um-zv"\nrope_length = "24 ft"',
        '"ei3"\nrope_length = "24 ft"\ndamping_ratio = 0.5',
        '[[row]] 1 ("long"): ei3 at tolerance 0.05 exists up to damping_ratio 0.27',
    ),
    "int32 without counts": ('"double"', '"int32"', "[drive] counts_per_m_s: missing"),
}


@pytest.mark.parametrize(("old", "new", "message"), BAD_MACHINES.values(), ids=BAD_MACHINES)
def test_a_bad_machine_file_builds_nothing(run, gantry, tmp_path, old, new, message):
    text = gantry.read_text()
    assert old in text
    gantry.write_text(text.replace(old, new))
    before = snapshot(tmp_path)
    done = run("build", gantry.name, "--json")
    assert message in done.err
    assert done.err.startswith("error: gantry.toml: ")
    assert (done.code, done.out) == (2, "")
    assert snapshot(tmp_path) == before


@pytest.mark.parametrize("command", ["build", "profile optimal", "profile invert", "profile simulate"])
def test_a_file_that_is_missing_or_no_toml_is_said_once_with_its_line(run, tmp_path, command):
    missing = run(*command.split(), "nowhere.toml")
    assert (missing.code, missing.out) == (2, "")
    assert missing.err == "error: nowhere.toml: cannot be read: there is no such file\n"
    (tmp_path / "naked.toml").write_text('name = "naked"\n[move]\ntick = 5 ms\n')
    naked = run(*command.split(), "naked.toml")
    assert naked.code == 2
    assert naked.err.startswith("error: naked.toml: line 3, column 10: 'tick = 5 ms': not valid TOML: ")
