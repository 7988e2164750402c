"""What can go wrong, each with what it takes to say so."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["CutOffWarning", "Diagnostic", "FrameError", "InputError", "SimulatorError", "UnsolvableError"]


@dataclass(frozen=True)
class Diagnostic:
    """One thing that is wrong with a file, and where: lines and columns count from 1, 0 is none."""

    file: str
    line: int
    column: int
    message: str
    hint: str


class InputError(ValueError):
    """A scene or a file of readings is bad; its text is all that is wrong with it."""

    def __init__(self, text: str, diagnostics: tuple[Diagnostic, ...] = ()) -> None:
        super().__init__(text, diagnostics)
        self.diagnostics = diagnostics

    def __str__(self) -> str:
        return str(self.args[0]).rstrip()


class FrameError(ValueError):
    """A frame has no answer: a reading is not finite, or its tractions would overflow."""

    def __init__(self, text: str, frame: int = 0) -> None:
        super().__init__(text, frame)
        self.frame = frame

    def __str__(self) -> str:
        return str(self.args[0])


class UnsolvableError(ArithmeticError):
    """The numbers are in their ranges, and there is no answer to them: it would be noise."""


class SimulatorError(RuntimeError):
    """ngspice failed; `deck` is what it was given, `log` what it said."""

    def __init__(self, text: str, deck: str = "", log: str = "") -> None:
        super().__init__(text, deck, log)
        self.deck = deck
        self.log = log

    def __str__(self) -> str:
        return str(self.args[0])


class CutOffWarning(UserWarning):
    """A file breaks off: what is whole of it was read, and its text says how many frames that is."""
