"""Ranges of the command line: each mistake is named, with what to write instead; what is written then is taken."""

import numpy as np
import pytest

from lubfric import Between, InputError, Measured, explain_fit, load_scene, traction
from lubfric._base import validate
from lubfric.output import in_percent, main, parse_ratios, parse_speeds


@pytest.mark.parametrize(
    "text, wrong, instead",
    [
        ("5:0:3", "begins at 5 m/s, above its end 0 m/s", "0:5:3"),
        ("-1:10:5", "begins at -1 m/s", "begin above 0"),
        ("1:10:1", "has 1 values", "or 1 for one value"),
        ("1:1:3", "begins and ends at 1 m/s", "write 1 for this value"),
        ("1:3", "has 2 parts", "low:high:count"),
        ("1:3:2.5", "has 2.5 values", "a whole number"),
        ("2 m/s:10 mm/s:3", "above its end 0.01 m/s", "10 mm/s:2 m/s:3"),
    ],
)
def test_a_wrong_range_of_speeds(text, wrong, instead):
    with pytest.raises(InputError) as error:
        parse_speeds("--speeds", text)
    message = str(error.value)
    assert message.startswith("--speeds") and wrong in message and instead in message and " -;" not in message


@pytest.mark.parametrize("text, wrong", [("5:0:3", "above its end 0"), ("-1:1:5:log", "no value at or below 0")])
def test_a_wrong_range_of_ratios(text, wrong):
    with pytest.raises(InputError, match=wrong):
        parse_ratios(text)


def test_the_unit_of_the_end_of_a_range_is_that_of_its_begin():
    """One unit behind both; a unit at the begin alone may be of it alone."""
    assert parse_ratios("5:50 %:4:linear") == pytest.approx([0.05, 0.2, 0.35, 0.5])
    np.testing.assert_allclose(parse_speeds("--speeds", "0.1:10 mm/s:3"), [1e-4, 1e-3, 1e-2])
    np.testing.assert_allclose(parse_speeds("--speeds", "1 m/s:2000 mm/s:2"), [1.0, 2.0])
    for text in ("1 mm/s:10:13", "1,5 mm/s"):
        with pytest.raises(InputError, match="give each its unit, or none|write a point in decimals"):
            parse_speeds("--speeds", text)


def test_ranges_in_equal_and_in_geometric_steps():
    np.testing.assert_allclose(parse_ratios("0:0.5:11"), 0.05 * np.arange(11))
    np.testing.assert_allclose(parse_ratios("0.01:0.04:4:linear"), [0.01, 0.02, 0.03, 0.04])
    np.testing.assert_allclose(parse_ratios("0.01:1:3"), [0.01, 0.1, 1.0])
    np.testing.assert_allclose(parse_speeds("--speeds", "1 mm/s:0.1 m/s:3"), [0.001, 0.01, 0.1])


@pytest.mark.parametrize("text", ["5,10,20", "1:50:3", "-5, 0", "3"])
def test_ratios_that_are_percentages_are_questioned(text):
    """Above 2 the surfaces move in opposite directions: a list of such ratios alone is likely in percent."""
    with pytest.raises(InputError, match="--ratios: .*opposite directions; did you mean .* %. Write 0"):
        parse_ratios(text)
    in_python = [float(word) for word in text.replace("1:50:3", "1,7,50").split(",")]
    with pytest.raises(InputError, match="ratios: .*opposite directions"):
        traction(load_scene("paper"), in_python)


@pytest.mark.parametrize(
    "text, ratios", [("300 %", [3.0]), ("5 %,10 %", [0.05, 0.1]), ("0.5,3", [0.5, 3.0]), ("1, 2", [1, 2])]
)
def test_ratios_of_any_size_are_taken_with_their_unit(text, ratios):
    assert parse_ratios(text) == pytest.approx(ratios)
    assert parse_ratios("0:50 %:11") == parse_ratios("0 %:50 %:11") == parse_ratios("0:0.5:11")
    given = in_percent(parse_ratios(text))
    np.testing.assert_allclose(validate.numbers("ratios", given, "-", 1e6), ratios)


def test_values_apart_by_blanks_lead_to_commas_and_repeated_ones_are_told(capsys):
    with pytest.raises(InputError, match="--speeds '0.1 0.2'; separate values by commas, 0.1,0.2"):
        parse_speeds("--speeds", "0.1 0.2")
    assert parse_speeds("--speeds", "0.1,0.2,0.1") == [0.1, 0.2]
    assert "--speeds: 1 value given twice, solved once" in capsys.readouterr().err
    assert parse_speeds("--speeds", "10 mm/s,20 mm/s") == pytest.approx([0.01, 0.02])


@pytest.mark.parametrize(
    "width, words", [("85", "did you mean '85 mm'"), ("85 m", "allowed: 0.05 to 0.6 m"), ("2", "0.6 m")]
)
def test_a_width_in_millimetres_is_questioned(tmp_path, capsys, width, words):
    (tmp_path / "traction.csv").write_text("x [-]\n1\n")
    assert main(["plot", str(tmp_path), "--contact", "0.1", "--width", width]) == 2
    assert main(["plot", str(tmp_path), "--width", width]) == 2
    assert words in capsys.readouterr().err


def test_ends_that_are_exchanged_are_told():
    with pytest.raises(InputError, match=r"low = 2 is not below high = 1; write the lower one first, Between\(1, 2\)"):
        Between(2, 1)
    data = Measured([0.1, 0.2, 0.3], [0.1, 0.1, 0.1])
    with pytest.raises(InputError, match="lowest = 2 MPa is not below highest = 1 MPa; write the lower one first"):
        explain_fit(load_scene("paper"), data, {"lubricant.eyring_stress": (2e6, 1e6)})
