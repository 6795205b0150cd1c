"""Independent verification of `lubfric`: finite elements, closed forms, published numbers, and campaigns of many cases.

``python -m verification --help`` lists the commands. `verification.fem` has finite-element solvers of its own
(`verification.fem.solvers`, which import nothing from `lubfric`), closed forms and published numbers, and the studies
that compare `lubfric` with them. `verification.campaigns` has what takes many cases: hostile input, coverage of the
intervals, charts of error against time, stability maps, mutants, the tables of the documents, benchmarks.
"""
