"""`swayless plot tradeoff`: a figure of a machine file, and refusals before any work."""

from __future__ import annotations

import json

import pytest

from swayless.machine import load_machine


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """Leave the sweep out, which takes seconds and is tested elsewhere; keep what it is asked for."""
    import swayless.report

    asked: list[object] = []
    whole = swayless.report.tradeoff_figure

    def coarse(name, need):
        asked.append((name, need))
        return whole(name, need, widths=2)

    monkeypatch.setattr(swayless.report, "tradeoff_figure", coarse)
    return asked


def test_the_figure_is_of_the_machine_of_the_file(run, gantry, drawn, tmp_path):
    done = run("plot", "tradeoff", gantry.name, "-o", "tradeoff.svg")
    assert (done.code, done.out, done.err) == (0, "tradeoff.svg: written\n", "")
    assert "what robustness costs at 5 %" in (tmp_path / "tradeoff.svg").read_text()
    ((name, need),) = drawn
    machine = load_machine(gantry)
    assert name == machine.name
    assert (need.band.low_hz, need.band.high_hz) == machine.plant.frequency_hz
    # 0.5 m/s at 0.5 m/s2
    assert (need.speed_m_s, need.ramp_up_s, need.ramp_down_s) == (0.5, 1.0, 1.0)
    assert need.on_rope


def test_json_names_the_figure(run, arm, drawn):
    done = run("plot", "tradeoff", arm.name, "-o", "a.png", "--json")
    assert json.loads(done.out) == {"figure": "a.png", "kind": "tradeoff", "designs": [arm.name]}
    assert not drawn[0][1].on_rope


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("plot tradeoff gantry.toml gantry.toml -o a.svg", "plot tradeoff draws one machine, 2 are given"),
        ("plot tradeoff none.toml -o a.svg", "none.toml: cannot be read: there is no such file"),
        ("plot tradeoff gantry.toml -o no/a.svg", "no/a.svg: cannot be written: there is no folder no"),
        ("plot tradeoff gantry.toml -o a.bmp", "a.bmp: suffix '.bmp' is no figure format"),
        ("plot tradeoff gantry.toml -o a.svg --row 2", "--row: belongs to plot response"),
        ("plot tradeoff gantry.toml -o a.svg --span 1 2", "--span: belongs to plot sensitivity"),
    ],
)
def test_wrong_usage_is_refused_before_anything_is_drawn(run, gantry, drawn, line, message):
    done = run(*line.split())
    assert (done.code, done.out) == (2, "")
    assert message in done.err
    assert drawn == []


def test_a_double_pendulum_is_refused_by_the_key_that_makes_it_one(run, gantry, drawn):
    text = gantry.read_text().replace(
        "[crane]", '[crane]\nsling_length = 2.0\nhook_mass = "200 kg"\nload_mass = "1000 kg"'
    )
    rows, _, _ = text.partition("[[row]]")
    gantry.write_text(rows + '[[row]]\nname = "all"\nfamily = "si"\nrope_length = ["9 ft", "29 ft"]\n')
    done = run("plot", "tradeoff", gantry.name, "-o", "a.svg")
    assert done.code == 2
    assert "[crane] sling_length: candidates are compared for one mode" in done.err
    assert drawn == []
