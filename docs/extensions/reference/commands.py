"""A page for each command, from the objects that parse it."""

import inspect
import re
from pathlib import Path

import rich_click as click

from colonnade.cli.app import app
from reference.markdown import cell, code, contents, table


def pages():
    """Make a page a command, and the list of all."""
    commands = dict(walk(app, "colonnade"))
    made = {f"commands/{name.replace(' ', '-')}.md": page(name, command) for name, command in commands.items()}
    rows = [
        (f"[`{name}`]({name.replace(' ', '-')}.md)", summary(command))
        for name, command in commands.items()
        if not isinstance(command, click.Group) or name == "colonnade"
    ]
    text = f"# Commands\n\n{paragraphs(app.help)}\n\n{table(('command', 'does'), rows)}"
    names = [name.replace(" ", "-") for name in commands]
    return made | {"commands/index.md": text + contents(names).replace(":maxdepth: 1", ":hidden:")}


def walk(command, name):
    """Give each command with the words that call it."""
    yield name, command
    for word, below in getattr(command, "commands", {}).items():
        yield from walk(below, f"{name} {word}")


def page(name, command):
    """Write how a command is called, what it does, its arguments and options, an example, its exit codes."""
    context = click.Context(command, info_name=name)
    usage = f"{name} {' '.join(command.collect_usage_pieces(context))}"
    parts = [f"# {name}\n\n{paragraphs(command.help)}\n\n```text\n{usage}\n```\n\n"]
    arguments = [each for each in command.get_params(context) if isinstance(each, click.Argument)]
    options = [each for each in command.get_params(context) if isinstance(each, click.Option) and not each.hidden]
    if isinstance(command, click.Group):
        rows = [
            (f"[`{word}`]({name.replace(' ', '-')}-{word}.md)", summary(each))
            for word, each in command.commands.items()
        ]
        parts.append("## Commands\n\n" + table(("command", "does"), rows))
    if arguments:
        rows = [(code(each.make_metavar(context)), form(each, context), default(each)) for each in arguments]
        parts.append("## Arguments\n\n" + table(("argument", "form", "default"), rows))
    parts.append(
        "## Options\n\n"
        + table(("option", "form", "default", "what it does"), [row(each, context) for each in options])
    )
    if example := (command.epilog or "").partition("Example: ")[2]:
        parts.append(f"## Example\n\n```sh\n{example}\n```\n\n")
    codes = re.split(r"; ", app.epilog.partition("Exit codes: ")[2].rstrip("."))
    parts.append("## Exit codes\n\n" + table(("code", "means"), [each.split(" ", 1) for each in codes]))
    return "".join(parts)


def row(option, context):
    """Write an option."""
    names = ", ".join(code(each) for each in (*option.opts, *option.secondary_opts))
    needed = "needed" if option.required else default(option)
    if option.multiple and not option.required:
        needed = ""
    described = option.help
    if not described:
        raise ValueError(f"{context.info_name} {option.opts[0]} has no help: write it at the option.")
    return names, form(option, context), needed, as_text(described)


def form(parameter, context):
    """Write what may be given."""
    if getattr(parameter, "is_flag", False):
        return "flag"
    kind = parameter.type
    many = " (may be repeated)" if getattr(parameter, "multiple", False) else ""
    if isinstance(kind, click.Choice):
        return " ".join(code(each) for each in kind.choices) + many
    metavar = parameter.metavar or parameter.make_metavar(context)
    return code(metavar.strip("[]")) + limits(kind) + many


def limits(kind):
    """Write the least and largest number of a type."""
    least, most = getattr(kind, "min", None), getattr(kind, "max", None)
    return "".join(
        f", {word} {limit:g}" for word, limit in (("at least", least), ("at most", most)) if limit is not None
    )


def default(parameter):
    """Write the default; empty without one."""
    value = parameter.to_info_dict().get("default")
    if value in (None, (), False, "") or callable(value) or "UNSET" in str(value):
        return ""
    if isinstance(value, Path) or str(value) == ".":
        return "the current folder"
    return code(value)


def summary(command):
    """Give the first sentence of a command's help."""
    return as_text(command.get_short_help_str(limit=200))


def paragraphs(text):
    """Write help as Markdown."""
    return "\n\n".join(as_text(each) for each in re.split(r"\n\s*\n", inspect.cleandoc(text or "")))


def as_text(text):
    """Keep words in capitals and brackets as they are."""
    return cell(text).replace("<", "\\<").replace("*", "\\*")
