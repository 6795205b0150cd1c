"""What only the paper's own way of solving needs (Akchurin et al. 2015, doi:10.1007/s11249-015-0536-z).

`contact`: the rough contact under an imposed film. `differential`: the film by differential deflection. Nothing else in
the library calls the latter: `lubfric.solve_ehl` solves the same equations on graded grids, and the two are held
against each other.
"""
