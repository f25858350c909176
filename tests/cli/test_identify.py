"""`swayless identify`: from a record to a machine file."""

from __future__ import annotations

import json

import numpy as np
import pytest

from swayless.machine import example_text, load_machine

FREQUENCY_HZ, DAMPING = 0.2, 0.004
TIME_S = np.arange(0.0, 80.0, 0.05)


def swing(frequency_hz=FREQUENCY_HZ, amplitude=0.1, noise=0.02, seed=1):
    w = 2.0 * np.pi * frequency_hz
    wave = np.exp(-DAMPING * w * TIME_S) * np.cos(np.sqrt(1.0 - DAMPING**2) * w * TIME_S)
    return amplitude * (wave + noise * np.random.default_rng(seed).normal(size=TIME_S.size))


def write(path, values, head="time_s,angle_rad"):
    rows = (f"{t:.2f},{v:.8g}\n" for t, v in zip(TIME_S, values, strict=True))
    path.write_text(f"{head}\n{''.join(rows)}", encoding="utf-8")
    return path


@pytest.fixture
def record(tmp_path):
    return write(tmp_path / "swing.csv", swing())


def found(done):
    assert (done.code, done.err) == (0, "")
    return json.loads(done.out)


def is_covered(mode, frequency_hz=FREQUENCY_HZ, damping_ratio=DAMPING):
    # 3.5 standard deviations: one in two thousand.
    return (
        abs(mode["frequency_hz"] - frequency_hz) < 3.5 * mode["frequency_hz_std"]
        and abs(mode["damping_ratio"] - damping_ratio) < 3.5 * mode["damping_ratio_std"]
    )


def test_a_record_gives_frequency_and_damping_with_their_uncertainty(run, record):
    document = found(run("identify", record, "--linear", "--json"))
    assert is_covered(document)
    low, high = document["held_hz"]
    assert high - low == pytest.approx(4.0 * document["frequency_hz_std"])
    (only,) = document["records"]
    assert (only["samples"], only["quantity"], only["noise_is_coloured"]) == (1600, "angle", False)
    # The noise was 2 % of an amplitude of 0.1; 1600 samples tell it to 2 % of itself, 4: four times that.
    assert only["noise_rms"] == pytest.approx(0.002, rel=0.08)


def test_the_printed_result_says_what_was_not_seen(run, record):
    done = run("identify", record)
    assert (done.code, done.err) == (0, "")
    assert "16.0 swings, 1,600 samples in 79.95 s" in done.out
    for what in ("noise: 2 % of", "second mode: none seen", "drift: ", "large swing: 5.7"):
        assert f"\n{what}" in done.out


def test_a_short_record_and_damping_below_resolution_are_said(run, tmp_path):
    path = write(tmp_path / "short.csv", swing(noise=0.1))
    out = run("identify", path, "--end", "9 s").out
    assert "\ntoo short: 1.8 swings" in out
    assert "\ndamping: below what this record resolves" in out


def test_a_part_in_which_the_crane_still_moved_is_pointed_out(run, tmp_path):
    moving = np.where(TIME_S < 8.0, 0.03 * (8.0 - TIME_S), 0.0)
    path = write(tmp_path / "moving.csv", swing() + moving, "time_s,sensor")
    assert "\nuneven: from 0 to 9.95 s the fit leaves " in run("identify", path).out
    assert "uneven" not in run("identify", path, "--start", "8").out


def test_heights_of_peaks_that_are_read_as_a_swing_are_refused_with_a_hint(run, tmp_path):
    rows = "".join(f"{k},{30.0 * 0.97**k:.1f}\n" for k in range(30))
    (tmp_path / "peaks.csv").write_text(f"swing,height\n{rows}")
    assert run("identify", "peaks.csv").err.endswith("; heights of peaks need --peaks\n")


def test_two_modes_are_printed_and_written_into_a_new_file(run, tmp_path):
    path = write(tmp_path / "two.csv", swing() + swing(0.23, 0.06, seed=2), "time_s,sensor")
    document = found(run("identify", path, "--json", "--into", "two.toml"))
    first, second = document["records"][0]["modes"]
    assert is_covered(first)
    assert is_covered(second, 0.23)
    assert len(load_machine(tmp_path / "two.toml").rows[0].bands) == 2


def test_two_modes_that_cannot_be_told_apart_are_refused(run, tmp_path):
    both = swing(noise=0.05) + swing(0.2035, 0.06, 0.05, seed=51)
    path = write(tmp_path / "close.csv", both, "time_s,sensor")
    done = run("identify", path)
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith(f"error: {path}: the record shows more than one mode, near 0.")
    assert run("identify", path, "--modes", "1").code == 0


@pytest.mark.parametrize("example", ["workshop-crane", "flexible-arm"])
def test_a_machine_file_gets_the_band_and_keeps_its_comments(run, record, tmp_path, example):
    machine = tmp_path / "machine.toml"
    single = example_text(example).replace("rope_length = [2.0, 10.0]", "rope_length = 6")
    machine.write_text(single.replace("frequency = [4.0, 5.0]", "frequency = [4.4, 4.6]"))
    document = found(run("identify", record, "--linear", "--into", machine, "--json"))
    low, high = load_machine(machine).plant.frequency_hz
    assert (low, high) == (
        pytest.approx(document["held_hz"][0], rel=2e-5),
        pytest.approx(document["held_hz"][1], rel=2e-5),
    )
    assert load_machine(machine).plant.damping_ratio == pytest.approx(document["damping_ratio"], rel=1e-3)
    assert machine.read_text().count("#") == example_text(example).count("#")
    assert document["into"] == str(machine)


def test_a_range_of_ropes_is_corrected_by_the_one_that_was_measured(run, record, tmp_path):
    machine = tmp_path / "crane.toml"
    machine.write_text(example_text("workshop-crane"))
    assert "give --rope-length" in run("identify", record, "--into", machine).err
    assert run("identify", record, "--rope-length", "6", "--into", machine).code == 0
    longest_m = 9.80665 / (2.0 * np.pi * load_machine(machine).plant.frequency_hz[0]) ** 2
    offset_m = 9.80665 / (2.0 * np.pi * FREQUENCY_HZ) ** 2 - 6.0
    # The record tells the pendulum to some cm; two standard deviations more are held.
    assert 10.0 + offset_m - 0.01 < longest_m < 10.0 + offset_m + 0.05


@pytest.mark.parametrize("told", [True, False])
def test_a_block_that_is_told_its_rope_is_said_to_need_that_of_the_pendulum(run, record, tmp_path, told):
    machine = tmp_path / "crane.toml"
    text = example_text("workshop-crane")
    machine.write_text(text.replace("[controller]", '[controller]\nlaw = "phase"') if told else text)
    out = run("identify", record, "--rope-length", "6", "--into", machine).out
    assert ("has to be told the pendulum's length from now on: what the crane shows and 0.205" in out) is told


def test_too_few_samples_in_a_swing_are_said(run, tmp_path):
    path = tmp_path / "slow.csv"
    rows = (f"{t:.2f},{v:.8g}\n" for t, v in zip(TIME_S[::36], swing()[::36], strict=True))
    path.write_text(f"time,x\n{''.join(rows)}")
    out = run("identify", path).out
    assert "\nsamples: 2.8 in a swing; a faster swing would look the same" in out
    assert "\ntime: nothing says its unit; taken for seconds" in out


def test_damping_that_was_not_seen_leaves_that_of_the_file(run, tmp_path):
    machine = tmp_path / "crane.toml"
    machine.write_text(example_text("workshop-crane"))
    path = write(tmp_path / "short.csv", swing(noise=0.1))
    assert run("identify", path, "--end", "9", "--rope-length", "6", "--into", machine).code == 0
    assert load_machine(machine).plant.damping_ratio == 0.002


def test_a_new_machine_file_can_be_built_and_holds_the_band(run, record, tmp_path):
    document = found(run("identify", record, "--into", "new.toml", "--json"))
    row = load_machine(tmp_path / "new.toml").rows[0]
    assert row.family == "si"
    done = run("build", "new.toml", "--no-verify", "--json")
    assert done.code == 0
    low, high = json.loads(done.out)["rows"][1]["frequency_hz"]
    assert low <= document["held_hz"][0]
    assert high >= document["held_hz"][1]


def test_several_ropes_give_their_offset(run, tmp_path):
    ropes = [3.0, 6.0, 9.0]
    for rope in ropes:
        frequency_hz = np.sqrt(9.80665 / (rope + 0.35)) / (2.0 * np.pi)
        write(tmp_path / f"{rope:g}.csv", swing(frequency_hz, 0.3, seed=int(rope)), "t,x")
    document = found(run("identify", "3.csv", "6.csv", "9.csv", "--rope-length", "3", "6 m", "9", "--json"))
    offset = document["rope_offset"]
    assert abs(offset["offset_m"] - 0.35) < 3.5 * offset["offset_m_std"]
    assert offset["consistent"]
    assert [each["rope_length_m"] for each in document["records"]] == ropes
    table = run(
        "identify", "3.csv", "6.csv", "9.csv", "--rope-length", "3", "6", "9", "--into", "crane.toml"
    ).out
    assert "rope offset: 0.3" in table
    low, high = load_machine(tmp_path / "crane.toml").plant.frequency_hz
    assert low < np.sqrt(9.80665 / 9.35) / (2.0 * np.pi) < np.sqrt(9.80665 / 3.35) / (2.0 * np.pi) < high


def test_ropes_stand_in_a_column_too(run, tmp_path):
    rows = "".join(
        f"{rope},{t:.2f},{v:.6g}\n"
        for rope in (3.0, 6.0)
        for t, v in zip(TIME_S, swing(np.sqrt(9.80665 / (rope + 0.2)) / (2.0 * np.pi)), strict=True)
    )
    (tmp_path / "all.csv").write_text(f"rope_m,t,x\n{rows}")
    offset = found(run("identify", "all.csv", "--rope-column", "rope_m", "--json"))["rope_offset"]
    assert abs(offset["offset_m"] - 0.2) < 3.5 * offset["offset_m_std"]


def test_a_stopwatch_gives_a_frequency_and_no_damping(run):
    document = found(run("identify", "--periods", "6.1", "6.0", "6.2", "--json"))
    assert document["frequency_hz"] == pytest.approx(1.0 / 6.1)
    assert document["frequency_hz_std"] == pytest.approx(0.13 / 6.1**2, rel=0.1)
    assert (document["damping_ratio"], document["damping_ratio_std"]) == (None, None)
    assert "a stopwatch does not show it" in run("identify", "--periods", "6.1").out
    corrected = found(run("identify", "--periods", "6.1", "--amplitude", "20 deg", "--json"))
    # 1 + a^2 / 16 + 11 a^4 / 3072 (Landau and Lifshitz, section 11).
    angle = np.radians(20.0)
    slower = 1.0 + angle**2 / 16.0 + 11.0 * angle**4 / 3072.0
    assert corrected["frequency_hz"] == pytest.approx(slower / 6.1, rel=1e-5)


def test_the_unit_and_the_decimal_mark_of_a_stopwatch_do_not_matter(run):
    seconds, milliseconds = (
        found(run("identify", "--periods", *periods, "--json"))["frequency_hz_std"]
        for periods in (("6,100", "6,000 s", "6,200"), ("6100 ms", "6000ms", "6200 ms"))
    )
    assert milliseconds == pytest.approx(seconds)


def test_a_swing_whose_rope_is_given_is_that_of_a_load(run, tmp_path):
    path = write(tmp_path / "sway.csv", swing(amplitude=0.5), "time_s,sway_m")
    assert "does not show whether it is one" in run("identify", path).out
    assert "does not show whether it is one" not in run("identify", path, "--rope-length", "6").out


def test_a_stopwatch_on_several_ropes_gives_their_offset(run):
    periods = [f"{2.0 * np.pi * np.sqrt((rope + 0.5) / 9.80665):.3f}" for rope in (2, 5, 10)]
    offset = found(run("identify", "--periods", *periods, "--rope-length", "2", "5", "10", "--json"))[
        "rope_offset"
    ]
    assert offset["offset_m"] == pytest.approx(0.5, abs=0.01)


def test_peaks_give_the_damping_and_a_stopwatch_the_period(run, tmp_path):
    fall = 2.0 * np.pi * 0.004
    rows = "".join(f"{k},{30.0 * np.exp(-fall * k):.2f}\n" for k in range(41))
    (tmp_path / "peaks.csv").write_text(f"swing,height_in\n{rows}")
    document = found(run("identify", "peaks.csv", "--peaks", "--periods", "5.9", "5.8", "--json"))
    assert document["damping_ratio"] == pytest.approx(0.004, rel=1e-3)
    assert document["period_s"] == pytest.approx(5.85)
    done = run("identify", "peaks.csv", "--peaks")
    assert (done.code, done.err) == (
        2,
        "error: peaks.csv: heights over counts of swings do not show the period: give --periods\n",
    )
    (tmp_path / "timed.csv").write_text(
        "time_s,height_in\n" + "".join(f"{5.8 * k},{30.0 * 0.97**k}\n" for k in range(9))
    )
    assert found(run("identify", "timed.csv", "--peaks", "--json"))["period_s"] == pytest.approx(5.8)
    done = run("identify", "timed.csv", "--peaks", "--periods", "5.8")
    assert done.err == "error: timed.csv: heights over times show the period: leave --periods out\n"


def test_the_fit_is_drawn(run, record, tmp_path):
    assert f"{tmp_path / 'fit.svg'}: written" in run("identify", record, "--plot", tmp_path / "fit.svg").out
    assert (tmp_path / "fit.svg").read_text().startswith("<?xml")
    done = run("identify", record, "--plot", "fit.txt")
    assert done.code == 2
    assert "is no figure format" in done.err


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        ((), "give a record, or --periods"),
        (("none.csv",), "none.csv: cannot be read: there is no such file"),
        (("--periods", "-6"), "--periods = -6: must be > 0"),
        (("--periods", "6,1", "60"), "readings from 6.1 to 60 s differ by more than half a swing: must be"),
        (("--periods", "6.1,6.0"), '--periods = "6.1,6.0": must be one value: blanks separate several'),
        (("--periods", "six"), '--periods = "six": is not a time: allowed units are s, ms, us, min'),
        (("swing.csv", "--periods", "6"), "--periods beside records: only with --peaks"),
        (("swing.csv", "--both-sides"), "--both-sides is for --peaks"),
        (("swing.csv", "--swings", "3"), "--amplitude and --swings are for --periods"),
        (("--periods", "6", "--amplitude", "3"), "--amplitude = '3': must be an angle with its unit"),
        (("--periods", "6", "--plot", "a.svg"), "--plot shows one sampled swing"),
        (("swing.csv", "--rope-length", "3", "4"), "--rope-length: 2 given, for 1 records: one for each"),
        (("swing.csv", "swing.csv"), "several records: give --rope-length for each"),
        (("swing.csv", "--rate", "10", "--time", "1"), "--rate and --time: only one of them"),
        (("swing.csv", "--end", "0.2"), "swing.csv: lines 2 to 1601: 5 samples: must be at least 8"),
        (("swing.csv", "--pendulum", "--column", "1", "--time", "2"), 'swing.csv: line 1: "angle_rad"'),
    ],
)  # fmt: skip
def test_wrong_usage_is_refused(run, record, arguments, problem):
    done = run("identify", *arguments)
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith(f"error: {problem}")


def test_a_failure_leaves_the_machine_file_alone(run, tmp_path):
    machine = tmp_path / "crane.toml"
    machine.write_text(example_text("workshop-crane"))
    write(tmp_path / "noise.csv", np.random.default_rng(0).normal(size=TIME_S.size))
    assert run("identify", "noise.csv", "--into", machine).code == 2
    assert machine.read_text() == example_text("workshop-crane")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["crane.toml", "noise.csv"]
