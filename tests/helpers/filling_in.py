"""Answers to what a draft of `init` asks, as a person gives them with an editor."""


def filled_in(drafted, answer):
    """Write the draft, each open line with `answer(table, key)`; and give its path."""
    lines = drafted.text.split("\n")
    for number in drafted.open:
        key = lines[number - 1].partition(" = ")[0]
        table = next(line for line in reversed(lines[:number]) if line.startswith("["))
        lines[number - 1] = f"{key} = {answer(table.strip('[]').rpartition('.')[2], key)}"
    drafted.path.write_text("\n".join(lines), encoding="utf-8")
    return drafted.path
