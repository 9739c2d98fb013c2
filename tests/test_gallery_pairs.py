"""The gallery's pairs of pictures: one for each fix the report asks for, 2006 being its before."""

import pytest

from landscape.files.assets import shipped
from landscape.gallery.fixes import FIXES
from landscape.keys import get, with_settings
from landscape.settings import preset


@pytest.mark.parametrize("fix", FIXES, ids=lambda fix: fix.name)
def test_every_pair_differs_in_settings_and_2006_is_its_before(fix) -> None:
    assert fix.off.keys() <= fix.on.keys() and dict(fix.off) != dict(fix.on)
    before = preset("2006")
    for key, value in fix.off.items():
        if fix.name != "R18":
            assert get(before, key) == value, key
    assert with_settings(before, fix.settings(True)) != with_settings(before, fix.settings(False))


def test_there_is_a_pair_for_each_fix_the_report_asks_for() -> None:
    assert {f"R{k}" for k in range(1, 20)} == {
        fix.name.rstrip("ab") for fix in FIXES if fix.name.startswith("R")
    }
    assert shipped().is_dir()
