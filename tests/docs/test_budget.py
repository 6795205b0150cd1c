"""The table of docs/tolerances.md has the shares of the tolerance that the code uses."""

from pages import ROOT

from lubfric.scene import budget

SHARES = {
    "grid of the film": f"{budget.FILM_GRID:g}, without contact {budget.FILM_ALONE:g}",
    "sum of the film's shear stress": f"{budget.SHEAR_SUM:g}",
    "cells of the rough contact": f"{budget.CONTACT_GRID:g}",
    "load and volume balance": f"{budget.BALANCE:g}",
    "balance on coarse cells": f"{budget.CORRECTED:g}",
    "solver of the rough contact": f"{budget.CONTACT:g}",
    "heat of film and surfaces that is neglected": f"{budget.HEAT:g}",
    "heat of the inlet that is neglected": f"{budget.INLET:g}",
    "interpolation of the curve of a flat contact": f"{budget.CURVE:g}",
}


def test_the_page_on_levels_quotes_the_budget():
    page = (ROOT / "docs" / "tolerances.md").read_text(encoding="utf-8")
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in page.splitlines() if line.startswith("|")]
    assert {what: share for share, what, _ in rows[2:]} == SHARES
