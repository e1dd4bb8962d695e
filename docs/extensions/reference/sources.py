"""Messages as the sources write them: findings with kind and severity, errors with their class."""

import ast
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

import colonnade

PACKAGE = Path(colonnade.__file__).parent
SEVERITIES = ("serious", "warning", "note")
TEXT, KIND, SEVERITY = "text", "kind", "severity"
FINDINGS = {
    **dict.fromkeys(SEVERITIES, (KIND, TEXT)),
    "Verdict": ("", "", TEXT, KIND, SEVERITY),
    "Departure": (KIND, "", "", "", TEXT),
    "Finding": (TEXT, KIND, SEVERITY),
}
"""What the arguments of the calls are that make findings."""

PASSED_ON = {"kind", "self.kind"}
"""Kinds that such a call got from another one of them, or from a list of doubts."""

ERRORS = ("CampaignError", "ReadError", "StageError", "StoreError", "UnitError", "ColonnadeError", "UsageError")


@dataclass(frozen=True, order=True)
class Message:
    """A message: `kind` of a finding or class of an error, its text with … for what changes, the module it is in."""

    kind: str
    severity: str
    text: str
    module: str


def findings():
    """Every finding that the code can make."""
    return sorted({found for module, tree in _modules() for found in _findings(module, tree)})


def errors():
    """Every error that the code raises for its users."""
    return sorted({found for module, tree in _modules() for found in _errors(module, tree)})


def _modules():
    for path in sorted(PACKAGE.rglob("*.py")):
        name = ".".join(("colonnade", *path.relative_to(PACKAGE).with_suffix("").parts))
        if name != "colonnade.findings":
            yield name.removesuffix(".__init__"), ast.parse(path.read_text(encoding="utf-8"))


def _calls(node, function=None):
    """Calls of a module, each with the function that it is in."""
    if isinstance(node, ast.FunctionDef):
        function = node
    if isinstance(node, ast.Call) and isinstance(node.func, (ast.Name, ast.Attribute)):
        yield node, getattr(node.func, "id", getattr(node.func, "attr", "")), function or node
    for below in ast.iter_child_nodes(node):
        yield from _calls(below, function)


def _findings(module, tree):
    for call, name, function in _calls(tree):
        if name not in FINDINGS or (isinstance(call.func, ast.Attribute) and name in SEVERITIES):
            continue
        given = dict(zip(FINDINGS[name], call.args, strict=False)) | {word.arg: word.value for word in call.keywords}
        if KIND not in given or ast.unparse(given[KIND]) in PASSED_ON:
            continue
        severity = _severities(name, given.get(SEVERITY), function)
        texts = _texts(given.get(TEXT), function) or [""]
        for kind in _constants(given[KIND], module):
            yield from (Message(kind, each, text, module) for each in severity for text in texts)
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "doubts":
            for doubt in node.value.elts:
                if isinstance(doubt, ast.Tuple):
                    texts = _texts(doubt.elts[1], tree) or [""]
                    yield from (Message(doubt.elts[0].value, "warning", text, module) for text in texts)


def _severities(name, node, function):
    if name in SEVERITIES:
        return [name]
    written = "" if node is None else ast.unparse(node)
    if isinstance(node, ast.Name):
        written = " ".join(ast.unparse(each) for each in _assigned(node, function))
    return [each for each in SEVERITIES if f"Severity.{each.upper()}" in written] or ["warning"]


def _constants(node, module):
    """Values of a kind: written out, one of two, or a constant of the module."""
    if isinstance(node, ast.Constant):
        return [node.value]
    if isinstance(node, ast.IfExp):
        return [*_constants(node.body, module), *_constants(node.orelse, module)]
    if isinstance(node, ast.Name):
        return [getattr(import_module(module), node.id)]
    raise ValueError(f"{module}, line {node.lineno}: the kind of a finding is not a constant: {ast.unparse(node)}")


def _errors(module, tree):
    raised = {id(node.exc) for node in ast.walk(tree) if isinstance(node, ast.Raise)}
    for call, name, function in _calls(tree):
        is_raised = id(call) in raised or name == "problem"
        if name in ("ValueError", "problem") and module.startswith("colonnade.campaign."):
            name = "CampaignError"  # what validators say of a key becomes a paragraph of it
        if is_raised and name in ERRORS and call.args:
            yield from (Message(name, "error", text, module) for text in _texts(call.args[0], function))


def _texts(node, function):
    """Texts that an expression can be; nothing where it is made elsewhere."""
    if isinstance(node, ast.Name):
        return [text for each in _assigned(node, function) for text in _texts(each, ast.Module([], []))]
    if isinstance(node, ast.IfExp):
        return [*_texts(node.body, function), *_texts(node.orelse, function)]
    text = _template(node)
    return [text] if text.replace("…", "").strip(" .,:;()\"'") else []


def _assigned(name, function):
    """Values of a name where it is used: the last one that was given to it before."""
    given = [
        node
        for node in ast.walk(function)
        if isinstance(node, ast.Assign)
        and node.lineno < name.lineno
        and any(ast.unparse(target) == name.id for target in node.targets)
    ]
    return [max(given, key=lambda node: node.lineno).value] if given else []


def _template(node):
    """Write an expression as text, with … for what is filled in."""
    if isinstance(node, ast.Constant):
        return str(node.value)
    if isinstance(node, ast.JoinedStr):
        return "".join(each.value if isinstance(each, ast.Constant) else "…" for each in node.values)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return _template(node.left) + _template(node.right)
    return "…"
