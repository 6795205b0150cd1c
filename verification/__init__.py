"""Independent verification of `lubfric`: finite elements, closed forms, convergence studies and a report.

``python -m verification --help`` says what there is. The solvers in `verification.fem` import nothing from `lubfric`.
The studies in `verification.studies` set the two side by side.
"""
