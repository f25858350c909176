"""`build`, `generate` and `verify` of a move computed ahead."""

import json
import re
import subprocess
from pathlib import Path

import pytest

from swayless.cli.app import main
from swayless.verify import find_compiler
from swayless.verify.structured_text import load

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "time-optimal-oscillator.toml"
PAGE = (ROOT / "docs" / "profile-block.md").read_text(encoding="utf-8")
NAME = "time_optimal_oscillator"
(SHOWN,) = re.findall(rf"```text\n({NAME}: .*?)```", PAGE, re.DOTALL)
FILES = [
    f"c/{NAME}_example.c",
    f"c/{NAME}_profile.c",
    f"c/{NAME}_profile.h",
    "figures/move.html",
    "figures/move.svg",
    f"st/FB_{NAME}_Profile.st",
    f"{NAME}.profile.json",
]
SMALL = """name = "cart"
[plant]
numerator = [1]
denominator = [1, 0, 0]
[move]
tick = "20 ms"
target = 0.05
limit = 2.0
rate_limit = 400
"""
FEW = ("--soak-ticks", "500")


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """The directory of the example, built once without the proof."""
    out = tmp_path_factory.mktemp("built") / "out"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.argv", ["swayless", "build", str(EXAMPLE), "-o", str(out), "--no-verify"])
        with pytest.raises(SystemExit):
            main()
    return out


@pytest.mark.usefixtures("blank_figures")
def test_the_example_builds_is_proved_and_can_be_checked_and_verified_again(run, tmp_path):
    out = tmp_path / "out"
    built = run("build", EXAMPLE, "-o", out, *FEW, "--json")
    document = json.loads(built.out)
    assert (built.code, document["verified"], document["design"]) == (0, "equal", "new")
    assert (document["ticks"], sorted(document["files"])) == (58, FILES)
    assert {part["code"].split()[0] for part in document["runs"]} == {"C", "ST"}
    assert document["guarantee"]["final_error_ratio"] <= 1e-9
    assert document["largest_input_ratio"] <= 1.0
    checked = run("build", EXAMPLE, "-o", out, "--check")
    assert (checked.code, checked.out) == (0, f"{out}: 5 files as generated, 2 figures there\n")
    again = run("build", EXAMPLE, "-o", out, "--no-verify")
    assert again.out.startswith(f"{SHOWN}design: kept as stored\nverified: not run (--no-verify)\n")
    code = out / "st" / f"FB_{NAME}_Profile.st"
    code.write_text(code.read_text().replace("Position := MoveStart +", "Position := MoveStart -"))
    verified = run("verify", out, *FEW)
    assert verified.code == 1
    assert "verified: C by" in verified.out
    assert "DIFFERS: ST by evaluator, LREAL" in verified.out


def test_a_stored_file_gives_the_same_code(run, stored, tmp_path):
    file = stored / f"{NAME}.profile.json"
    for language in ("c", "st"):
        made = run("generate", language, file, "-o", tmp_path / language, "--json")
        assert made.code == 0
        for name in json.loads(made.out)["files"]:
            assert (tmp_path / language / name).read_bytes() == (stored / language / name).read_bytes()
    assert run("generate", "c", file, "-o", stored / "c", "--check").code == 0


def test_a_stored_file_is_proved_for_its_own_number_type_only(run, stored):
    file = stored / f"{NAME}.profile.json"
    verified = run("verify", file, "--json", *FEW)
    assert (verified.code, json.loads(verified.out)["verified"]) == (0, "equal")
    for command in (("verify", file), ("generate", "c", file, "-o", "c")):
        refused = run(*command, "--number", "float")
        assert refused.code == 2
        assert "is proved for its own number type" in refused.err


def test_a_damaged_stored_file_is_replaced_by_build_and_refused_by_others(run, stored, tmp_path):
    text = (stored / f"{NAME}.profile.json").read_text()
    out = tmp_path / "out"
    out.mkdir()
    file = out / f"{NAME}.profile.json"
    file.write_text(text.replace('"hold_ratio"', '"hold"', 1))
    refused = run("generate", "c", file, "-o", tmp_path / "c")
    assert refused.code == 2
    assert "hold_ratio" in refused.err
    built = run("build", EXAMPLE, "-o", out, "--no-verify", "--json")
    assert json.loads(built.out)["design"].startswith("replaces a stored one that is damaged: ")


def test_another_move_replaces_the_stored_one_and_says_what_differs(run, tmp_path):
    file, out = tmp_path / "cart.toml", tmp_path / "out"
    file.write_text(SMALL)
    assert run("build", file, "-o", out, "--no-verify").code == 0
    file.write_text(SMALL.replace("limit = 2.0\nrate_limit = 400", "limit = 100"))
    built = run("build", file, "-o", out, *FEW)
    assert re.search(r"design: replaces the stored one, \d+ differences, the first: limit", built.out)
    # So fast that no stop is sooner than the end of the move: three ticks.
    assert re.search(r"; at rest at most 2 ticks, \S+ s, after an abort\n", built.out)
    assert "stop: none would be much sooner than the end of the move\n" in built.out
    assert "verified: ST by evaluator, LREAL" in built.out


def test_a_move_with_a_rate_limit_is_proved_in_float(run, tmp_path):
    file = tmp_path / "cart.toml"
    file.write_text(SMALL + 'number = "float"\n')
    built = run("build", file, "-o", tmp_path / "out", *FEW, "--json")
    document = json.loads(built.out)
    assert (built.code, document["verified"], document["number"]) == (0, "equal", "float")
    assert document["max_travel"] < 1.0
    assert {part["code"].split(", ")[1] for part in document["runs"]} == {"float", "REAL"}


def test_a_directory_without_code_is_refused(run, stored, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "a.profile.json").write_text((stored / f"{NAME}.profile.json").read_text())
    refused = run("verify", out)
    assert refused.code == 2
    assert "holds no generated code in c or st" in refused.err


WANTED = [0.0] * 3 + [1.0] * 80 + [0.25] * 140 + [30.0] * 60
"""Where the axis shall be, tick by tick, beyond its limits in the end; the drive fails once."""

UP_AT, RESTS_AT = 2, 0.25
"""The measurement is up at tick 2: before, it gives what is no place at all, and a wrong one."""


def signals():
    """What happens at the axis: a move, one that the drive interrupts, one too early, one too far."""
    for tick, wanted in enumerate(WANTED):
        measured = (1e300, 7.0, RESTS_AT)[min(tick, 2)]
        yield tick % 80 == 5 or tick == 1, tick not in {0, 1, 100}, wanted, measured


def test_the_wiring_of_the_page_gives_the_same_in_c_and_structured_text(stored, tmp_path):
    (text,) = re.findall(r"```iecst\n(.*?)```", PAGE, re.DOTALL)
    outer = load((stored / "st" / f"FB_{NAME}_Profile.st").read_text() + text).instantiate()
    found = []
    for go, ready, wanted, measured in signals():
        pins = {"Go": go, "DriveReady": ready, "WantedPosition": wanted, "MeasuredPosition": measured}
        out = outer.step(pins)
        found.append((out["DriveInput"], out["Fault"]))
    assert max(abs(value) for value, _ in found[UP_AT:]) > 4.0
    assert found[UP_AT] == (RESTS_AT, False)  # held where it was measured when that was up
    assert [fault for _, fault in found[:UP_AT]] == [True, True]
    assert any(fault for _, fault in found[UP_AT:])
    assert printed(stored, tmp_path) == found


MAIN = """
#include <stdio.h>
int main(void)
{
    static const double rows[][4] = {@ROWS@};
    unsigned tick;
    bool fault;
    axis_start();
    for (tick = 0u; tick < sizeof rows / sizeof rows[0]; ++tick) {
        const double *row = rows[tick];
        const double input = axis_input(row[0] > 0.5, row[1] > 0.5, row[2], row[3], &fault);
        printf("%.17g %d\\n", input, (int)fault);
    }
    return 0;
}
"""


def printed(stored, tmp_path):
    """What the wiring in C gives."""
    (wiring,) = re.findall(r"```c\n(.*?)```", PAGE, re.DOTALL)
    rows = ", ".join("{" + ", ".join(repr(float(value)) for value in row) + "}" for row in signals())
    (tmp_path / "main.c").write_text(wiring + MAIN.replace("@ROWS@", rows))
    program = tmp_path / "main.exe"
    sources = [tmp_path / "main.c", stored / "c" / f"{NAME}_profile.c"]
    flags = ["-std=c99", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", f"-I{stored / 'c'}"]
    subprocess.run([*find_compiler().command, *flags, *sources, "-o", program], check=True)
    done = subprocess.run([program], capture_output=True, text=True, check=True)
    return [(float(value), fault == "1") for value, fault in map(str.split, done.stdout.splitlines())]


def test_a_file_that_is_not_there_is_named(run, stored, tmp_path):
    out = tmp_path / "out"
    for part in ("c", "st"):
        (out / part).mkdir(parents=True)
        for file in (stored / part).iterdir():
            (out / part / file.name).write_bytes(file.read_bytes())
    (out / f"{NAME}.profile.json").write_bytes((stored / f"{NAME}.profile.json").read_bytes())
    (out / "c" / f"{NAME}_profile.c").unlink()
    refused = run("verify", out)
    assert refused.code == 2
    assert f"{NAME}_profile.c: is not there: `build` wrote it" in refused.err


@pytest.mark.parametrize("command", [("simulate",), ("plot", "response", "-o", "a.svg")])
def test_commands_for_shapers_refuse_the_stored_file_in_one_sentence(run, stored, command):
    refused = run(*command, stored / f"{NAME}.profile.json")
    assert refused.code == 2
    said = "stores the block of a motion profile, which 'swayless generate' and 'swayless verify' take"
    assert said in " ".join(refused.err.split())
    assert refused.err.count("schema") == 1


def test_a_schema_that_is_not_known_is_all_that_is_said(run, stored, tmp_path):
    file = tmp_path / "a.profile.json"
    file.write_text((stored / f"{NAME}.profile.json").read_text().replace("profile/1", "profile/7"))
    refused = run("generate", "c", file, "-o", tmp_path / "c")
    assert refused.code == 2
    assert refused.err.count("unknown") == 1
