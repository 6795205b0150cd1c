"""How the tolerance on the friction coefficient is divided, and how far a share may loosen or tighten a solver.

These numbers are only here; docs/tolerances.md quotes them. The shares are upper bounds, rarely reached together. An
error of the film reaches f by a factor (`lubfric.models.load_sharing.Response.per_film`), by which the tolerance of the
film is divided.
"""

# Shares of the tolerance on f. Choices: a larger one leaves less to the others, a smaller one takes more work.
FILM_GRID = 0.3  # grid of the film
FILM_ALONE = 0.6  # grid of the film where there is no contact
SHEAR_SUM = 0.3  # sum of the film's shear stress over its nodes
CONTACT_GRID = 0.4  # grid of the rough contact
BALANCE = 5e-2  # residual of the balance of load and volume
CORRECTED = 0.15  # residual of this balance on coarse cells, where f is corrected for it to first order
CONTACT = 0.1  # solver of the rough contact
HEAT = 0.2  # change of f by heat of film and surfaces that is neglected
INLET = 2e-3  # change of the film by heat of the inlet that is neglected: it costs nothing, and parts of f may cancel
CURVE = 0.3  # interpolation of a contact curve

# Bounds of the tolerances that are required of a solver, however little or much of its error reaches f. Choices: looser
# ones may leave a solver without a solution nearby, tighter ones meet rounding.
LOOSEST_FILM = 0.03
TIGHTEST_FILM = 2e-4
LOOSEST_VOLUME = 0.02  # of the central film, if that is thinner than the mean one
TIGHTEST_VOLUME = 1e-7  # of the mean gap
TIGHTEST_CONTACT = 1e-9  # of the length in which the contact's solver measures the gap
MOST_FILM_CELLS = 1536  # largest number of cells of a film whose shear stress is not resolved
SLOPE = 0.3  # error of the slope by which a balance is corrected for its cells and for its remaining residual
MOST_MOVED = 0.1  # largest change of ln(F_H/F_C) by that correction: a light contact follows it exponentially
SLACK = 1.5  # factor on a tolerance up to which another solve is not worth its time

# The most that holds where f is not known yet (`Numerics.tolerance_of`). Choices, as above.
FIRST_FILM = 0.01
FIRST_CONTACT = 1e-3
FIRST_VOLUME = 1e-3
OF_PARTS = {"film": (FILM_GRID, FIRST_FILM), "contact": (CONTACT, FIRST_CONTACT), "balance": (BALANCE, FIRST_VOLUME)}
