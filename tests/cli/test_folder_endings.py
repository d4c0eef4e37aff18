"""A folder's name does not end as a file's: what cannot be written is refused, not made a folder of."""

import pytest

from fmu_bearing.files import check_file, check_folder


@pytest.mark.parametrize("command", ["sound", "sensitivity", "modes", "error-motion"])
def test_an_unknown_ending_is_refused(run, silent_file, tmp_path, command):
    refused = run(command, silent_file, "-o", tmp_path / "out.uff")
    assert refused.exit_code == 2 and refused.stderr.count("\n") == 1
    assert (
        f"out.uff: a folder is written here, and .uff is the ending of a file: name a folder, as {tmp_path}"
        in (refused.stderr)
    )
    assert not (tmp_path / "out.uff").exists()


@pytest.mark.parametrize(("command", "ending"), [("report", ".html"), ("build", ".fmu")])
def test_a_file_has_the_ending_of_what_it_is(run, silent_file, tmp_path, command, ending):
    refused = run(command, silent_file, "-o", tmp_path / "out.uff")
    assert refused.exit_code == 2 and refused.stderr.count("\n") == 1
    assert f"out.uff: a{'n FMU' if ending == '.fmu' else ' report'} is written as {ending}" in refused.stderr
    assert not list(tmp_path.glob("out*"))


def test_folders_that_are_there_or_have_other_dots_are_taken(tmp_path):
    (tmp_path / "old.csv").mkdir()
    for name in ("old.csv", "v1.2", "a.results", "plain"):
        assert check_folder(tmp_path / name) == tmp_path / name
    # a file may lie in any folder
    assert check_file(tmp_path / "new.uff" / "a.csv") == tmp_path / "new.uff" / "a.csv"
