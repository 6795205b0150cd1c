"""What stands in for the pictures of a command where they are not the matter: they take most of the time of a small
run, also of one in a process of its own (``leave_out()``, with this folder on the path)."""

from lubfric.output import commands

# Not a picture, but it ends like one.
STAND_IN = b"a picture IEND\xaeB`\x82"

DRAW = commands.RunFolder.draw
MAKE_READY = commands.figures.make_ready


def stand_in(folder, name, *_) -> None:
    """Put something in the place of the picture ``name``."""
    folder.contents[name] = STAND_IN


def leave_out(replace=setattr) -> None:
    """No picture of a run is drawn, and matplotlib is not made ready for them; ``replace``: as `setattr`."""
    replace(commands.figures, "make_ready", lambda: None)
    replace(commands.RunFolder, "draw", stand_in)


def put_back(replace=setattr, names=None) -> None:
    """Pictures are drawn again, or those of ``names`` alone; ``replace``: as `setattr`."""

    def draw(folder, name, *how) -> None:
        (DRAW if names is None or name in names else stand_in)(folder, name, *how)

    replace(commands.figures, "make_ready", MAKE_READY)
    replace(commands.RunFolder, "draw", draw)
