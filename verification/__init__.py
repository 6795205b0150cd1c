"""Independent verification of `lubfric`: finite elements, closed forms, convergence studies and a report.

``python -m verification --help``. The solvers in `verification.fem` import nothing from `lubfric`; the
studies in `verification.studies` set the two side by side.
"""
