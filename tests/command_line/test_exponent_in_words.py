"""Exponents of certificates on the command line, with an error and without."""

from jointplay.command_line.certificate import exponent_in_words

FOUND = {"value": 158.0, "error": 12.34, "lowest": 101.0, "highest": 203.0, "windows": 8}


def test_an_exponent_has_its_error_and_what_it_was_in_each_window() -> None:
    assert exponent_in_words(FOUND) == "158 ± 12 1/s, 1e+02 to 2e+02 over 8 windows"


def test_an_exponent_of_one_window_has_no_error_and_says_so() -> None:
    found = FOUND | {"error": None, "windows": 1}
    assert exponent_in_words(found) == "158 1/s, of too short a time to know its error"
