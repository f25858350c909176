"""Records as people have them: read, or refused with the line that is wrong."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.errors import FileError
from swayless.machine.identified_record import Reading, read_peaks, read_swings
from swayless.machine.identified_table import load_table
from swayless.plant.identification import Quantity

TIMES = np.round(np.linspace(0.0, 4.75, 20), 2)
VALUES = np.round(np.cos(TIMES), 3)
ROWS = "".join(f"{t},{v}\n" for t, v in zip(TIMES, VALUES, strict=True))
SEMICOLONS = "decimal commas need semicolons between the columns"


@pytest.fixture
def read(tmp_path):
    """Read one record from a text."""

    def read(text, **reading):
        path = tmp_path / "swing.csv"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_swings(load_table(path), Reading(**reading))

    return read


def refusal(read, text, **reading):
    with pytest.raises(FileError) as caught:
        read(text, **reading)
    return [problem.partition("swing.csv: ")[2] for problem in caught.value.problems]


@settings(derandomize=True, deadline=None, max_examples=60)
@given(
    separator=st.sampled_from([",", ";", "\t", " ", " ; ", ", "]),
    comma=st.booleans(),
    head=st.sampled_from(
        [
            "",
            "time [s]{0}angle [rad]\n",
            "t{0}phi\n",
            "# a remark\n\ntime_s{0}angle_rad\n",
            "t{0}x\ns{0}rad\n",
        ]
    ),
    end=st.sampled_from(["\n", "\r\n", "\r"]),
    first=st.sampled_from(["", "sep={0}\n"]),
    coding=st.sampled_from(["utf-8", "utf-8-sig", "utf-16"]),
    quoted=st.booleans(),
    values=st.lists(st.floats(-1e6, 1e6, allow_subnormal=False), min_size=8, max_size=12),
)
def test_every_dialect_gives_the_same_numbers(
    tmp_path_factory, separator, comma, first, head, end, coding, quoted, values
):
    times = 0.1 * np.arange(len(values))
    decimal = "," if comma and separator.strip() != "," else "."
    quote = '"' if quoted and separator.strip() else ""

    def cell(number):
        return f"{quote}{number!r}{quote}".replace(".", decimal)

    rows = "".join(f"{cell(float(t))}{separator}{cell(v)}\n" for t, v in zip(times, values, strict=True))
    path = tmp_path_factory.mktemp("dialect") / "swing.csv"
    text = first.format(separator.strip(" ") or " ") + head.format(separator) + rows
    path.write_bytes(text.replace("\n", end).encode(coding))
    (found,) = read_swings(load_table(path), Reading())
    np.testing.assert_array_equal(found.record.time_s, times)
    np.testing.assert_array_equal(found.record.value, values)


@pytest.mark.parametrize(
    ("head", "quantity", "size"),
    [
        ("time [s],angle [deg]", Quantity.angle, np.pi / 180.0),
        ("time (ms),sway (mm)", Quantity.position, 1e-3),
        ("t_s,accel_m_s2", Quantity.acceleration, 1.0),
        ("Zeit in s,Winkel in rad", Quantity.angle, 1.0),
        ("time,load / ft", Quantity.position, 0.3048),
        ("time,sensor [V]", Quantity.value, 1.0),
        ("time,a [g]", Quantity.acceleration, 9.80665),
        ("time,x [m/s²]", Quantity.acceleration, 1.0),
        ("time,winkel [°]", Quantity.angle, np.pi / 180.0),
    ],
)
def test_heads_say_what_was_measured(read, head, quantity, size):
    (found,) = read(f"{head}\n{ROWS}")
    assert found.record.quantity is quantity
    np.testing.assert_allclose(found.record.value, VALUES * size, rtol=1e-15)
    assert found.record.time_s[-1] == pytest.approx(0.00475 if "ms" in head else 4.75)


@pytest.mark.parametrize(
    ("head", "unit_s"),
    [
        ("millis", 1e-3),
        ("time_msec", 1e-3),
        ("tMs", 1e-3),
        ("timestamp_ns", 1e-9),
        ("time [µs]", 1e-6),
        ("time [minutes]", 60.0),
        ("hours", 3600.0),
        ("time in days", 86400.0),
        ("time_stamp", 1.0),
    ],
)
def test_heads_say_what_times_are_in(read, head, unit_s):
    (found,) = read(f"{head},x\n{ROWS}")
    np.testing.assert_allclose(found.record.time_s, TIMES * unit_s, rtol=1e-15)
    assert found.time_unit_is_assumed is (head == "time_stamp")


@pytest.mark.parametrize("head", ["time [10ms]", "time / fortnights", "Zeit in Jahren", "time_cs", "t\nfoo"])
def test_a_unit_of_time_that_is_not_known_is_not_taken_for_seconds(read, head):
    text = f"{head},x\n{ROWS}" if "\n" not in head else f"t,x\nfoo,rad\n{ROWS}"
    (problem,) = refusal(read, text)
    assert problem.startswith("line 1: ")
    assert "is no unit of time; known: s, ms, us, min, ns, h, d" in problem
    # Only what is joined to a name may be a word: whoever names the column says that it holds seconds.
    assert ("--time 1" in problem) is (head == "time_cs")


def test_names_that_end_like_a_unit_of_time_are_no_times(read):
    for head in ("angle_min", "xMin", "peak_h", "gyro deg/s"):
        assert read(f"time [s],{head}\n{ROWS}")[0].record.time_s[-1] == 4.75


def test_times_that_no_clock_shows_in_seconds_need_their_unit(read):
    rows = "".join(f"{1_700_000_000_000 + 250 * k},{v}\n" for k, v in enumerate(VALUES))
    assert "too large for seconds: say their unit" in refusal(read, f"timestamp,x\n{rows}")[0]
    assert read(f"timestamp [ms],x\n{rows}")[0].record.duration_s == pytest.approx(4.75)


def test_a_rate_beside_times_is_refused(read):
    assert refusal(read, f"time,x\n{ROWS}", rate_hz=4.0) == [
        'line 1: "time" holds the times: --rate is for a file without; leave it out, or rename that column'
    ]


def test_readings_that_failed_are_refused_with_their_lines(read):
    bad = "".join(
        f"{t},{-999 if k in {0, 9} else v}\n" for k, (t, v) in enumerate(zip(TIMES, VALUES, strict=True))
    )
    why = "value = -999 stands alone, far outside of the swing: leave its cell empty if the reading failed"
    # Two of 80 readings: less than the twentieth at either end that may have failed.
    text = f"time,x\n{bad}" + "".join(f"{t},{np.cos(t):.3f}\n" for t in np.arange(5.0, 20.0, 0.25))
    assert refusal(read, text) == [f"line {line}: {why}" for line in (2, 11)]


def test_a_rope_in_an_unknown_unit_is_not_taken_for_metres(read):
    text = "t,rope [yd],x\n" + "".join(f"{k},{10 if k < 12 else 20},{np.cos(k)}\n" for k in range(30))
    assert refusal(read, text, rope_column="2") == ['line 1: "rope [yd]": is not a length that is known']


def test_columns_are_found_by_head_or_number(read):
    text = "n,time_s,left_rad,right_rad\n" + "".join(
        f"{k},{t},{v},{-v}\n" for k, (t, v) in enumerate(zip(TIMES, VALUES, strict=True))
    )
    for column in ("right_rad", "RIGHT", "4"):
        np.testing.assert_array_equal(read(text, time="2", column=column)[0].record.value, -VALUES)
    assert refusal(read, text, time="2") == ['which one is the swing? give --column: "left_rad", "right_rad"']
    assert refusal(read, text, column="5") == [
        '--column = "5": no such column; known: "n", "time_s", "left_rad", "right_rad", or 1 to 4'
    ]


def test_a_unit_given_replaces_that_of_the_head(read):
    (found,) = read(f"time,x\n{ROWS}", unit="deg")
    assert found.record.quantity is Quantity.angle
    assert refusal(read, ROWS, unit="furlong")[0].startswith(
        '--unit = "furlong": unknown unit; known: rad, mrad, deg'
    )


def test_one_column_needs_a_rate(read):
    column = "".join(f"{v}\n" for v in VALUES)
    assert refusal(read, column) == ["line 1: one column: give --rate, or a file with a column of times"]
    (found,) = read(column, rate_hz=4.0)
    np.testing.assert_allclose(found.record.time_s, TIMES)


@pytest.mark.parametrize("missing", ["", "NaN", "nan", "N/A", "-"])
def test_missing_values_are_left_out_and_counted(read, missing):
    (found,) = read(f"time,x\n{ROWS}5.0,{missing}\n5.25,0.5\n")
    assert (found.missing, found.record.time_s.size) == (1, 21)


def test_a_part_can_be_read(read):
    (found,) = read(ROWS, start_s=1.0, end_s=4.0)
    assert (found.record.time_s[0], found.record.time_s[-1]) == (1.0, 4.0)


def test_a_rope_column_makes_a_record_of_each_rope(read):
    text = "t,rope_length_ft,x\n" + "".join(f"{k},{10 if k < 12 else 20},{np.cos(k)}\n" for k in range(30))
    first, second = read(text, rope_column="rope_length")
    assert (first.rope_length_m, second.rope_length_m) == (pytest.approx(3.048), pytest.approx(6.096))
    assert (first.record.time_s.size, second.record.time_s.size) == (12, 18)
    assert (
        refusal(read, text.replace(",20,", ",0,"), rope_column="2")[0]
        == "line 14: rope length = 0: must be > 0"
    )


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "is empty: a record has a line for each sample, with a time and a value"),
        ("# only a remark\n\n", "is empty: a record has a line for each sample, with a time and a value"),
        ("time,x\n", "line 1: has no numbers: a record has a line for each sample"),
        (f"time,x\n{ROWS}5.0,high\n", 'line 22: "high" is not a number'),
        (f"time,x\n{ROWS}5.0,1_000\n", 'line 22: "1_000" is not a number'),
        (f'time,x\n{ROWS}"5.0,1\n5.25,1\n', "line 22: has 1 cells, where there are 2 columns"),
        (f"time,x\n{ROWS}5.0,1,2\n", "line 22: has 3 cells, where there are 2 columns"),
        ("t,x\n0,0,1,5\n", f"line 2: has 4 cells, where there are 2 columns; {SEMICOLONS}"),
        (f"time,x\n{ROWS}4.75,0.1\n", "line 22: time = 4.75 s does not come after 4.75 s"),
        (f"time,x\n{ROWS}1.0,0.1\n", "line 22: time = 1 s does not come after 4.75 s"),
        ("t\tx\n\t1\n", "line 2: the time is missing or infinite"),
        (f"time,x\n{ROWS},0.1\n", "line 22: the time is missing or infinite"),
        (f"time,x\n{ROWS}5.0,inf\n", "line 22: value is infinite"),
        ("time,x\n0,1\n1,2\n", "lines 2 to 3: 2 samples: must be at least 8"),
        ("sep=;\n", "is empty: a record has a line for each sample, with a time and a value"),
        ("time,x\n0,1\0\n", "line 2: holds null bytes, which no text does: save it as UTF-8"),
        (b"\xff\xfet", "is not UTF-16 text, as its first bytes say: save it as UTF-8"),
        (b"time,x\n0,\xb0\n", "is not UTF-8 text: byte 0xb0 in line 2"),
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_refused_with_its_line(read, text, problem):
    assert refusal(read, text) == [problem]


def test_all_problems_are_said_at_once_and_many_are_counted(read):
    problems = refusal(read, ROWS + "x,y\n" * 8)
    assert len(problems) == 11
    assert problems[-1] == "and 6 more lines like these"


def test_peaks_are_read_over_times_or_swings(tmp_path):
    path = tmp_path / "peaks.csv"
    path.write_text("swing,height_in\n0,25\n1,24\n2,\n3,22\n4,21\n")
    at, height, are_times = read_peaks(load_table(path), Reading())
    assert (list(at), list(height), are_times) == ([0.0, 1.0, 3.0, 4.0], [25.0, 24.0, 22.0, 21.0], False)
    path.write_text("time_s;height_mm\n0,5;25\n1,5;-24\n")
    with pytest.raises(FileError, match="line 3: height = -24: must be finite and > 0"):
        read_peaks(load_table(path), Reading())
    path.write_text("time_s;height_mm\n0,5;25\n1,5;24\n")
    assert read_peaks(load_table(path), Reading())[2]


@pytest.mark.parametrize(
    ("head", "steps", "are_times"),
    [
        ("cycle,h\n", "0 0.5 1.0 1.5", False),
        ("", "0 5.83 11.7 17.4", True),
        ("t,h\n", "0 6 12 18", True),
        ("Cycle number,h\n", "0 1 2 3", False),
        ("at [s],h\n", "0 6 12 18", True),
    ],
)
def test_counts_of_swings_are_told_from_times(tmp_path, head, steps, are_times):
    path = tmp_path / "peaks.csv"
    path.write_text(head + "".join(f"{step},{20 - index}\n" for index, step in enumerate(steps.split())))
    assert read_peaks(load_table(path), Reading())[2] is are_times


@pytest.mark.parametrize("steps", ["0 6 12 18", "1 2 3 5", "0 0.5 1.0 1.5"])
def test_whole_numbers_without_a_head_may_be_times_or_counts_and_are_asked_for(tmp_path, steps):
    path = tmp_path / "peaks.csv"
    path.write_text("".join(f"{step},{20 - index}\n" for index, step in enumerate(steps.split())))
    with pytest.raises(FileError, match='"column 1" may be times or counts of swings: give it a head'):
        read_peaks(load_table(path), Reading())
    assert read_peaks(load_table(path), Reading(time="1"))[2]


@pytest.mark.parametrize("head", ["index,time,angle", "n,t,x", "#,sec [s],x", ",time,x", "sample,Zeit,x"])
def test_a_named_time_goes_before_an_index(read, head):
    rows = "".join(f"{k},{t},{v}\n" for k, (t, v) in enumerate(zip(TIMES, VALUES, strict=True)))
    # A head that begins with # is a remark, unless it stands in quotes.
    (found,) = read(f"{head}\n{rows}".replace("#", '"#"'))
    np.testing.assert_array_equal(found.record.time_s, TIMES)
    np.testing.assert_array_equal(found.record.value, VALUES)


@pytest.mark.parametrize("head", ["index,angle\n", "Sample no,x\n", "foo,x\n", ",x\n", ""])
def test_counts_of_samples_are_no_seconds(read, head):
    text = head + "".join(f"{k},{v}\n" for k, v in enumerate(VALUES))
    assert (
        "counts samples or swings, which are no times: give --rate, or --time 1 if it"
        in refusal(read, text)[0]
    )
    np.testing.assert_array_equal(read(text, time="1")[0].record.time_s, np.arange(VALUES.size))
    np.testing.assert_array_equal(read(text, rate_hz=4.0, column="2")[0].record.time_s, TIMES)
