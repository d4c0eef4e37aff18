"""Rows of CSV files: separators, decimal commas, remarks, numbers of lines, what is no table."""

import numpy as np
import pytest

from fmu_bearing.results.rows import read_columns, read_rows


def read(tmp_path, text):
    file = tmp_path / "table.csv"
    file.write_bytes(text.encode())
    titles, rows = read_rows(file)
    return [[title.written for title in titles], *rows] if titles else rows


@pytest.mark.parametrize("separator", [";", "\t", ","])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_the_first_line_names_the_separator(tmp_path, separator, end):
    lines = ["name{0}value", "P1{0} 1.5", '"a {0} b"{0}', '  {0}"2" ']
    found = read(tmp_path, "\ufeff" + end.join(lines).format(separator) + end)
    assert found == [
        ["name", "value"],
        (2, ["P1", "1.5"]),
        (3, [f"a {separator} b", ""]),
        (4, ["", "2"]),
    ]


def test_one_column_has_commas_between_what_is_too_much(tmp_path):
    assert read(tmp_path, "time\n0,5\n") == [["time"], (2, ["0", "5"])]


NUMBERS = [
    ("1,5", "1.5"), ("-80,5", "-80.5"), ("+0,25", "+0.25"), (",5", ".5"), ("-,5", "-.5"),
    ("1,5e3", "1.5e3"), ("1,5E-3", "1.5E-3"), ("1,5e+03", "1.5e+03"),
]  # fmt: skip
OTHERS = [
    "1.5", "12", "", "1.000,5", "1,000,5", "1,", ",", "1,5 N", "a,5", "1,5e", "1,e5", "--1,5", "1,5,",
    "(0,1)", "\u0661,\u0665",  # Arabic digits
]  # fmt: skip


@pytest.mark.parametrize("separator", [";", "\t"])
def test_a_decimal_comma_becomes_a_point(tmp_path, separator):
    table = "".join(f"x{separator}{text}\n" for text in ["value", *dict(NUMBERS), *OTHERS])
    _, *rows = read(tmp_path, table)
    cells = [cells[1] for _, cells in rows]
    assert cells == [*dict(NUMBERS).values(), *OTHERS]
    assert [cell.written for cell in cells] == [*dict(NUMBERS), *OTHERS]


def test_between_commas_a_comma_in_quotes_is_no_decimal_comma(tmp_path):
    """It may be one between thousands."""
    assert read(tmp_path, 'a,b\n"1,500",2\n')[1] == (2, ["1,500", "2"])


def test_remarks_and_empty_lines_keep_the_numbers(tmp_path):
    text = '# saved by: a; "b\n\n  # another\na,b\n#1,2\n,\n \n3,4#5\n"#6",7\n'
    assert read(tmp_path, text) == [["a", "b"], (8, ["3", "4#5"]), (9, ["#6", "7"])]


def test_a_cell_over_two_lines_ends_in_the_second(tmp_path):
    assert read(tmp_path, 'a,b\n"1\n2",3\n4,5\n') == [["a", "b"], (3, ["1\n2", "3"]), (4, ["4", "5"])]


@pytest.mark.parametrize("text", ["", "\n\n", "# a,b\n", " , \n"])
def test_nothing_is_no_row(tmp_path, text):
    assert read(tmp_path, text) == []


def test_windows_1252_is_read_and_named(tmp_path):
    """As a spreadsheet on Windows saves CSV: a degree sign, a dash and an umlaut are one byte each."""
    file = tmp_path / "table.csv"
    file.write_bytes("time;T [°C];Größe\n0;20,5;–\n".encode("cp1252"))
    with pytest.warns(UserWarning, match=r"table\.csv is not UTF-8 and is read as Windows-1252: 'time;T \["):
        titles, rows = read_rows(file)
    assert [title.written for title in titles] == ["time", "T [°C]", "Größe"]
    assert rows == [(2, ["0", "20.5", "–"])]
    file.write_bytes("\ufefftime;T [°C]\n0;20,5\n".encode("utf-16-be"))
    assert read_rows(file)[1] == [(2, ["0", "20.5"])]


def test_what_is_no_table(tmp_path):
    with pytest.raises(ValueError, match=r"none\.csv: there is no such file"):
        read_rows(tmp_path / "none.csv")
    with pytest.raises(ValueError, match="cannot be read: it is a folder"):
        read_rows(tmp_path)
    # a control character, a byte that Windows-1252 does not have, one after the mark of UTF-8
    for data in (b"a,b\n\xe4\0,1\n", b"a,b\n\x81,1\n", b"\xef\xbb\xbfa,b\n\xe4,1\n"):
        (tmp_path / "binary.csv").write_bytes(data)
        with pytest.raises(ValueError, match="cannot be read as text in UTF-8"):
            read_rows(str(tmp_path / "binary.csv"))
    # a cell beyond 131072 characters, the limit of Python's module csv: a quote that nobody closes
    with pytest.raises(ValueError, match=r"table\.csv: line 3: is not a line of a table: field larger"):
        read(tmp_path, 'a,b\n1,2\n"' + 140_000 * "x" + "\n")


@pytest.mark.parametrize("speed", ["15.000", "-15.000"])
def test_points_beside_decimal_commas_are_asked_for(tmp_path, speed):
    """A spreadsheet's thousands are not decimals; alone, or beside points, 15.000 is 15."""
    path = tmp_path / "it.csv"
    path.write_text(f"time;speed\n0;{speed}\n0,1;16000\n")
    with pytest.raises(
        ValueError, match=f"line 2, column 'speed': '{speed}' has a point where other numbers"
    ):
        read_columns(path)
    path.write_text("time;speed\n0;15.000\n1;16.5\n")
    np.testing.assert_array_equal(read_columns(path).values[:, 1], [15.0, 16.5])
