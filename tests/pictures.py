"""What stands in for the pictures of a command where they are not the matter: they take most of the time of a small
run, also of one in a process of its own (``leave_out()``, with this folder on the path)."""

from pathlib import Path

PLOTS = ("run_curve.plot_stribeck", "run_curve.plot_traction", "run_curve.plot_contact", "run_history.plot_history")


def stand_in(path, *_) -> None:
    """Not a picture, but it ends like one."""
    Path(path).write_bytes(b"a picture IEND\xaeB`\x82")


def leave_out(replace=setattr) -> None:
    """No picture of a run is drawn, and matplotlib is not made ready for them; ``replace``: as `setattr`."""
    from lubfric.output import commands, run_curve, run_history

    replace(commands.figures, "make_ready", lambda: None)
    replace(commands, "plot_surface", stand_in)
    for name in PLOTS:
        module, plot = name.split(".")
        replace({"run_curve": run_curve, "run_history": run_history}[module], plot, stand_in)
