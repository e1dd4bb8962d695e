"""The command `colonnade`, one module for each command or two: it parses, calls the workflow and prints."""

from __future__ import annotations

import gc
import io
import os
import sys
from collections.abc import Sequence
from typing import NoReturn

from colonnade import interruption

INTERRUPTED = 130
"""Exit code of Ctrl-C and of a polite kill; click's own is 1, which means here that a test failed."""
INTERRUPTION = "Interrupted. Finished results are kept; run the same command again to continue."


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """
    Run the command line and leave with its exit code.

    0 all good; 1 some test failed, the others are done; 2 usage or campaign file; 130 interrupted.
    """
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:  # closed by the shell (`>&-`): nobody reads it
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115, PTH123 — until the end
        if isinstance(stream, io.TextIOWrapper):
            # A console that cannot show θ or ± gets a question mark, not a traceback.
            stream.reconfigure(errors="replace")
    gc.set_threshold(10_000, 20, 50)  # what libraries make stays: looking for garbage in it takes a tenth of a command
    interruption.listen()
    try:
        code = invoke(arguments)
    except (KeyboardInterrupt, Exception) as error:  # the import of a compiled module makes an ImportError of it
        if not (interruption.noted() or isinstance(error, KeyboardInterrupt)):
            raise
        sys.stderr.write(f"{INTERRUPTION}\n")
        code = INTERRUPTED
    interruption.stop_listening()
    # An interrupt within `exec` of a text, as dataclasses do at import, makes Python end itself by SIGINT although it
    # was caught (its `unhandled_keyboard_interrupt`); another such `exec` makes it forget.
    exec("")
    sys.exit(code)


def invoke(arguments: Sequence[str] | None = None) -> int:
    """
    Run one command and return its exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        Arguments after `colonnade`; by default those of this process.
    """
    import rich_click as click

    from colonnade.cli.app import app
    from colonnade.cli.common.console import close_output, complain
    from colonnade.errors import SHORT_OF_MEMORY, CampaignError, ColonnadeError

    try:
        code = app.main(arguments, prog_name="colonnade", standalone_mode=False)
    except click.ClickException as error:
        error.show(sys.stderr)
        return error.exit_code
    except (KeyboardInterrupt, click.Abort):
        complain(INTERRUPTION)
        return INTERRUPTED
    except ColonnadeError as error:
        complain(str(error))
        return 2 if isinstance(error, CampaignError) else 1
    except MemoryError:
        complain(SHORT_OF_MEMORY)
        return 1
    except OSError as error:
        complain(f"{error.filename or 'A file'}: {error.strerror or error}")
        return 1
    finally:
        close_output()
    return int(code or 0)
