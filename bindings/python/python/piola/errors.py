"""Exceptions of the package. All derive from `Error`, and those about what was given from ValueError."""


class Error(Exception):
    """Anything that piola refuses."""

    def __init__(self, message, *details):
        super().__init__(message, *details)
        self.message = message

    def __str__(self):
        return self.message


class MaterialError(Error, ValueError):
    """A material that does not exist, or parameters that are missing, unknown or out of range."""


class DeclarationError(Error, ValueError):
    """A text that declares no energy.

    `mistakes` has them all: pairs of a message and of its line, column, both from 1, and length, or None.
    """

    def __init__(self, message, mistakes=()):
        super().__init__(message, mistakes)
        self.mistakes = mistakes


class DomainError(Error, ValueError):
    """Points outside the domain of an energy, or not finite.

    `first` is the index of the first of them; `refused` and `nonfinite` say how many there are of each kind.
    """

    def __init__(self, message, first=(), refused=0, nonfinite=0):
        super().__init__(message, first, refused, nonfinite)
        self.first = tuple(first)
        self.refused = refused
        self.nonfinite = nonfinite


class FitError(Error, ValueError):
    """Measurements to which nothing can be fitted."""


class ContractError(Error, ValueError):
    """An energy that breaks rules that every material must keep."""


class BodyError(Error, ValueError):
    """A mesh, a material, pins or settings that make no body or no simulation."""


class StepError(Error, RuntimeError):
    """A step without a next state, or a state without reactions. The state is untouched."""
