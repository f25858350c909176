"""`swayless verify`: what is there is proved as it stands; a difference is exit 1, a missing tool exit 3."""

from __future__ import annotations

import importlib.util
import json
import shutil
import sys

import pytest

from tests.cli.conftest import snapshot


@pytest.fixture
def built(run, designs, tmp_path):
    """A directory with a design and its code, as a build leaves it, but for the figures."""
    folder = tmp_path / "built"
    folder.mkdir()
    shutil.copy(designs / "taps.json", folder / "zv.design.json")
    assert run("generate", "c", folder / "zv.design.json", "-o", folder / "c").code == 0
    assert run("generate", "st", folder / "zv.design.json", "-o", folder / "st").code == 0
    return folder


def change(path, old, new):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def verify(run, *arguments):
    return run("verify", *arguments, "--soak-ticks", 0)


def test_code_as_generated_is_equal(run, built):
    done = verify(run, built)
    assert (done.code, done.err) == (0, "")
    assert done.out.count("equal, bit for bit") == 12
    assert [line[:13] for line in done.out.splitlines()[-2:]] == ["verified: C b", "verified: ST "]


def test_a_change_by_hand_in_c_is_found_and_said(run, built):
    change(built / "c" / "zv_shaper.c", "s->status = 0u;", "s->status = 1u;")
    done = verify(run, built)
    assert done.code == 1
    assert "DIFFERS: C by " in done.out
    assert "first: steps, tick 0, status: expected 2, got 3" in done.out
    assert "verified: ST by evaluator, LREAL" in done.out


def test_a_change_by_hand_in_structured_text_is_found_and_said(run, built):
    change(built / "st" / "FB_zv_Shaper.st", "ReferenceNow := Ramped;", "ReferenceNow := 0.5 * Ramped;")
    done = verify(run, built)
    assert done.code == 1
    assert "DIFFERS: ST by evaluator, LREAL: 6 of 6 runs; first: steps, tick" in done.out
    assert ", reference: expected " in done.out
    told = json.loads(verify(run, built, "--json").out)
    assert told["verified"] == "differs"
    assert {run["equal"] for run in told["runs"] if run["code"].startswith("ST")} == {False}
    assert {run["equal"] for run in told["runs"] if run["code"].startswith("C ")} == {True}


@pytest.mark.parametrize(
    ("path", "message"),
    [("c/zv_shaper.c", "does not accept zv_shaper.c:"), ("st/FB_zv_Shaper.st", "FB_zv_Shaper.st: line ")],
)
def test_code_that_is_none_fails_with_the_name_of_its_file(run, built, path, message):
    (built / path).write_text("garbage\n")
    done = verify(run, built)
    assert (done.code, done.out) == (1, "")
    assert message in done.err
    assert "Traceback" not in done.err
    told = verify(run, built, "--json")
    assert (told.code, told.err) == (1, "")
    assert json.loads(told.out)["verified"] == "failed"
    assert message in json.loads(told.out)["reason"]


def test_text_that_is_not_ascii_is_refused_by_name(run, built):
    change(built / "c" / "zv_shaper.c", "zv: command shaper", "zv: Kommandoformer f\u00fcr Kr\u00e4ne")
    done = verify(run, built)
    assert (done.code, done.out) == (2, "")
    assert "zv_shaper.c: is not ASCII text: byte " in done.err


def test_a_language_that_is_not_there_is_named(run, built):
    shutil.rmtree(built / "st")
    done = verify(run, built)
    assert done.code == 0
    assert f"Structured Text: not verified, there is none in {built / 'st'}\n" in done.out
    shutil.rmtree(built / "c")
    assert "holds no generated code in c or st" in verify(run, built).err


def test_a_design_without_code_beside_it_is_refused(run, built):
    shutil.copy(built / "zv.design.json", built / "other.design.json")
    assert "holds 2 files *.design.json" in verify(run, built).err


def test_a_design_in_counts_is_verified_in_every_number_type(run, designs):
    for number, codes in (("double", 2), ("float", 2), ("int32", 1)):
        done = verify(run, designs / "counts.json", "--number", number, "--json")
        told = json.loads(done.out)
        assert (done.code, told["verified"], len(told["runs"])) == (0, "equal", 6 * codes)
        assert ("st" in told["left_out"]) is (number == "int32")


def without_compilers(monkeypatch):
    find = importlib.util.find_spec
    monkeypatch.setenv("PATH", "/nonexistent")
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "ziglang" else find(name))


def test_without_a_compiler_verification_exits_3_and_says_what_would_help(
    run, arm, designs, monkeypatch, tmp_path
):
    without_compilers(monkeypatch)
    before = snapshot(tmp_path)
    for arguments in (("verify", designs / "taps.json"), ("build", arm.name)):
        done = run(*arguments)
        assert (done.code, done.out) == (3, "")
        assert (
            "no C compiler on this machine: install gcc or clang, or run pip install 'swayless[verify]'"
            in done.err
        )
    assert "--no-verify builds without the proof" in done.err
    assert snapshot(tmp_path) == before


def test_a_compiler_that_is_named_and_missing_is_not_replaced_by_another(run, designs, monkeypatch):
    monkeypatch.setattr("swayless.verify.toolchain.shutil.which", lambda name: None)
    done = run("verify", designs / "taps.json", "--compiler", "clang")
    assert (done.code, done.out) == (3, "")
    assert "no clang on this machine" in done.err


def test_without_the_parser_of_structured_text_verification_exits_3(run, designs, monkeypatch):
    monkeypatch.setitem(sys.modules, "tree_sitter", None)
    done = verify(run, designs / "taps.json")
    assert (done.code, done.out) == (3, "")
    assert "pip install 'swayless[verify]'" in done.err
