"""The public interface of planarimpact, read from its sources: signatures, docstrings, links.

Nothing is imported, so a solver that crashes is documented like any other.
"""

import ast
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "planarimpact"


def modules(package=PACKAGE):
    """Public modules by dotted name: docstring, imports, and public members in order.

    Parameters
    ----------
    package : Path
        Folder of the package.

    Returns
    -------
    dict
        `{module: {"doc", "names", "exports", "members"}}`. `names` says what the module's names
        stand for, in dotted form; `exports` lists functions and classes that it hands on from
        where they are defined; each of `members` has `name`, `kind`, `signature`, `doc`, and a
        class the `members` that are its public methods.
    """
    found = {}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package.parent).with_suffix("").parts
        if any(part.startswith("_") and part not in ("__init__", "__main__") for part in parts):
            continue
        name = ".".join(part for part in parts if part != "__init__")
        tree = ast.parse(path.read_text(encoding="utf-8"))
        members = [_member(name, node) for node in tree.body if _is_public(node)]
        imported = _imports(tree)
        found[name] = {
            "doc": ast.get_docstring(tree) or "",
            "names": imported | {m["name"].split(".")[-1]: m["name"] for m in members},
            "exports": [imported[export] for export in _exports(tree) if export in imported],
            "members": members,
        }
    known = anchors(found)
    for module in found.values():
        homes = [home(export, found) for export in module["exports"]]
        module["exports"] = [name for name in homes if name in known]
    return found


def home(name, reference):
    """Dotted name of where something is defined that may have been imported from elsewhere."""
    module, _, last = name.rpartition(".")
    meant = reference.get(module, {"names": {}})["names"].get(last, name)
    return name if meant == name else home(meant, reference)


def anchors(reference):
    """Dotted names of all modules, members and methods: what can be linked to."""
    found = set(reference)
    for module in reference.values():
        for member in module["members"]:
            found |= {member["name"], *(method["name"] for method in member["members"])}
    return found


def functions_of_figure(reference, figure):
    """Functions of planarimpact that the curves of a figure use, in the order of their use.

    Functions of other modules of curves are replaced by those that these use.

    Parameters
    ----------
    reference : dict
        What `modules` gave.
    figure : str

    Returns
    -------
    list of str
        Dotted names, that of the curves themselves first.
    """
    functions = {m["name"] for r in reference.values() for m in r["members"] if m["kind"] == "def"}
    start = f"stronge1994.curves.{figure}"
    found, todo, seen = [reference[start]["names"]["curves"]], [start], set()
    while todo:
        module = todo.pop(0)
        seen.add(module)
        tree = ast.parse(_path(module).read_text(encoding="utf-8"))
        for name in _used(tree, _imports(tree)):
            used = home(name, reference)
            other = used.rpartition(".")[0]
            if other.startswith("stronge1994.curves."):
                todo += [other] if other not in seen | set(todo) else []
            elif used in functions and used not in found:
                found.append(used)
    return found


def target(name, module, reference, known):
    """Anchor that a name in a docstring of `module` means, or None.

    Parameters
    ----------
    name : str
        As in the docstring, perhaps dotted.
    module : str
        Where it stands.
    reference, known : dict, set
        What `modules` and `anchors` gave.
    """
    first, _, rest = name.partition(".")
    meant = [reference[home]["names"].get(first) for home in (module, "planarimpact")]
    candidates = [f"{dotted}.{rest}" if rest else dotted for dotted in meant if dotted]
    candidates += [name, f"{module}.{name}", f"{module.rpartition('.')[0]}.{name}"]
    candidates += [f"planarimpact.{name}"]
    homes = [home(candidate, reference) for candidate in candidates]
    return next((candidate for candidate in homes if candidate in known), None)


def _path(module):
    path = PACKAGE.parent.joinpath(*module.split("."))
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def _is_public(node):
    kinds = ast.FunctionDef, ast.ClassDef
    return isinstance(node, kinds) and (not node.name.startswith("_") or node.name == "__call__")


def _member(home, node):
    name = f"{home}.{node.name}"
    member = {"name": name, "doc": ast.get_docstring(node) or "", "members": []}
    if isinstance(node, ast.FunctionDef):
        result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
        signature = f"{node.name}({ast.unparse(node.args)}){result}"
        return member | {"kind": "def", "signature": signature}
    # The fields of a tuple are what it is made from.
    fields = [ast.unparse(child) for child in node.body if isinstance(child, ast.AnnAssign)]
    given = ", ".join(fields or map(ast.unparse, node.bases))
    member["members"] = [_member(name, child) for child in node.body if _is_public(child)]
    return member | {"kind": "class", "signature": f"{node.name}({given})" if given else node.name}


def _imports(tree):
    """What the imported names of planarimpact stand for, `{name: dotted name}`."""
    return {
        alias.asname or alias.name: f"{node.module}.{alias.name}"
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("planarimpact")
        for alias in node.names
    }


def _used(tree, names):
    """Dotted names of what is used of the imported `names`."""
    outer = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    found = [names[export] for export in _exports(tree) if export in names]
    for node in ast.walk(tree):
        if isinstance(node, (ast.Attribute, ast.Name)) and id(node) not in outer:
            first, _, rest = ast.unparse(node).partition(".")
            if first in names:
                found.append(f"{names[first]}.{rest}" if rest else names[first])
    return found


def _exports(tree):
    """What `__all__` lists."""
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return ast.literal_eval(node.value)
    return []
