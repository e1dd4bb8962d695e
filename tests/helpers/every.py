"""One test that asserts a sentence of many cases: it tries all, and reports each that fails with its name."""

import inspect
from functools import wraps

import pytest


def every(names, cases, ids=repr):
    """Call a test with each case in turn, as `pytest.mark.parametrize` would in tests of their own."""
    arguments = [names] if isinstance(names, str) else names
    cases = list(cases)
    assert cases, "no case, no test"

    def decorate(test):
        @wraps(test)
        def looped(**fixtures):
            failures = []
            for case in cases:
                values = dict(zip(arguments, [case] if isinstance(names, str) else case, strict=True))
                try:
                    test(**fixtures, **values)
                except (Exception, BaseExceptionGroup, pytest.fail.Exception) as failure:
                    failure.add_note(", ".join(f"{name} = {ids(value)}" for name, value in values.items()))
                    failures.append(failure)
            if failures:
                raise BaseExceptionGroup(f"{len(failures)} of {len(cases)} cases", failures)

        signature = inspect.signature(test)
        kept = [each for name, each in signature.parameters.items() if name not in arguments]
        looped.__signature__ = signature.replace(parameters=kept)  # type: ignore[attr-defined]
        del looped.__wrapped__
        return looped

    return decorate
