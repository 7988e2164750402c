"""Files that are refused, and recordings of which only a part is whole: a sentence for each."""

from __future__ import annotations

import warnings

from .errors import CutOffWarning, Diagnostic, InputError


def refused(where: str, message: str, hint: str = "") -> InputError:
    """In the words of the library: the file, what is wrong, what to do."""
    text = f"{where}: error: {message}" + (f"\nhint: {hint}" if hint else "")
    return InputError(text, (Diagnostic(where, 0, 0, message, hint),))


def cut_off(where: str, frames: int, reason: str) -> str:
    """Warns that these are all the frames that are whole, and returns the note of it."""
    note = f"cut off: {frames} whole frames, then {reason}"
    warnings.warn(f"{where}: {note}", CutOffWarning, stacklevel=2)
    return note


def counted(number: int, what: str) -> str:
    """ "1 frame", "2 frames"."""
    return f"{number} {what}" if number == 1 else f"{number} {what}s"
