"""Which program decides a result, whatever its comments and docstrings say.

The modules that decide what realization k is are found by following imports from `ROOT`, and hashed as syntax trees
without docstrings: a changed formula is a new program, a changed sentence about it is not.
"""

import ast
import hashlib
from collections.abc import Mapping
from functools import cache
from pathlib import Path

ROOT = "campaign.simulation.ground"
"""The module that turns a scene and an id into a record."""

HOME = Path(__file__).parents[2]
"""The directory in which the packages `campaign` and `solver` lie."""


def realization_hash(home: Path = HOME) -> str:
    """Return the SHA-256 of the program that decides what realization k is; `home` holds both packages."""
    return program_hash(deciding_modules(home))


def package_hash(package: str, home: Path = HOME) -> str:
    """Return the SHA-256 of all modules of a package."""
    return program_hash({name: path for name, path in _modules(home).items() if name.split(".")[0] == package})


def deciding_modules(home: Path = HOME) -> dict[str, Path]:
    """Return the files that `realization_hash` covers, by the name of their module."""
    modules = _modules(home)
    deciding = _reached(ROOT, modules) | {name for name in modules if name.split(".")[0] == "solver"}
    return {name: modules[name] for name in sorted(deciding)}


def program_hash(modules: Mapping[str, Path]) -> str:
    """Return the SHA-256 of the program in these files, by the name of their module."""
    digest = hashlib.sha256()
    for name in sorted(modules):
        digest.update(f"# {name}\n{_program(modules[name].read_bytes())}\n".encode())
    return digest.hexdigest()


def _modules(home: Path) -> dict[str, Path]:
    files = (path for package in ("campaign", "solver") for path in (home / package).rglob("*.py"))
    return {_name(path.relative_to(home)): path for path in files}


def _name(path: Path) -> str:
    parts = path.with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _reached(root: str, modules: Mapping[str, Path]) -> set[str]:
    reached: set[str] = set()
    ahead = {root}
    while ahead:
        name = ahead.pop()
        reached.add(name)
        ahead |= _imports(modules[name].read_bytes()) & modules.keys() - reached
    return reached


@cache  # several hashes cover the same file, and each start of a campaign asks for all of them
def _imports(source: bytes) -> set[str]:
    found: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return found


@cache
def _program(source: bytes) -> str:
    tree = ast.parse(source)
    for node in ast.walk(tree):
        body: list[ast.stmt] = getattr(node, "body", [])
        if isinstance(body, list):
            kept = [line for line in body if not _is_text(line)]
            node.body = kept or [ast.Pass()] if body else body  # type: ignore[attr-defined]
    return ast.unparse(tree)


def _is_text(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
