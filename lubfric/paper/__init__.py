"""Methods of the paper that nothing else here needs (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z).

`contact`: the rough contact under an imposed film. `differential`: the film by differential deflection. The latter
serves for comparison only: `lubfric.solve_ehl` solves the same equations on graded grids, and each checks the other.
"""
