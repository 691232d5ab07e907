"""The stubs name what the module has, no more and no less, with the same arguments and defaults."""

import ast
import inspect
import pathlib
import re

import vegard

STUBS = ast.parse((pathlib.Path(vegard.__file__).parent / "__init__.pyi").read_text())
KEPT_OUT = {"__init__", "__module__", "__doc__", "__repr__", "__new__", "__hash__"}


def stub_names(body):
    names = {}
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            names[node.target.id] = node
    return names


def own_names(thing):
    return {name for name in vars(thing) if name not in KEPT_OUT and not name.startswith("_pybind11")}


def arguments(function):
    """('x', 'y=3') of a stub."""
    spec, found = function.args, []
    names = [one.arg for one in spec.args]
    defaults = [None] * (len(names) - len(spec.defaults)) + spec.defaults
    found += list(zip(names, defaults))
    if spec.kwonlyargs:
        found.append(("*", None))
        found += [(one.arg, default) for one, default in zip(spec.kwonlyargs, spec.kw_defaults)]
    return [name if default is None else f"{name}={ast.literal_eval(default)!r}" for name, default in found]


def arguments_of_docstring(function):
    """The same of the first line of a docstring, which pybind11 makes of the function itself."""
    line = function.__doc__.splitlines()[0]
    inside = line[line.index("(") + 1 : line.rindex(") ->")]
    depth, word, words = 0, "", []
    for letter in inside + ",":
        depth += (letter in "[(") - (letter in ")]")
        if letter == "," and depth == 0:
            words.append(word.strip())
            word = ""
        else:
            word += letter
    found = []
    for word in filter(None, words):
        name, default = re.match(r"(\*|\w+)(?::.*?)?(?: = (.*))?$", word).groups()
        found.append(name if default is None else f"{name}={ast.literal_eval(default)!r}")
    return found


def test_names_are_those_of_the_module():
    assert set(stub_names(STUBS.body)) == set(vegard.__all__)


def test_classes_have_the_same_members_and_arguments():
    for name, node in stub_names(STUBS.body).items():
        thing = getattr(vegard, name)
        if isinstance(node, ast.FunctionDef):
            assert arguments(node) == arguments_of_docstring(thing), name
        if not isinstance(node, ast.ClassDef):
            continue
        members = stub_names(node.body)
        if name == "Error":
            assert set(members) <= set(vars(thing))
            continue
        assert set(members) == own_names(thing), name
        for member, stub in members.items():
            is_property = isinstance(inspect.getattr_static(thing, member), property)
            is_stub_property = isinstance(stub, ast.AnnAssign) or bool(stub.decorator_list)
            assert is_property == is_stub_property, f"{name}.{member}"
            if not is_property and not member.startswith("__"):
                assert arguments(stub) == arguments_of_docstring(getattr(thing, member)), f"{name}.{member}"


def test_everything_says_what_it_is():
    for name in vegard.__all__:
        thing = getattr(vegard, name)
        if name == "__version__":
            continue
        assert thing.__doc__, name
        if not isinstance(thing, type):
            continue
        assert thing.__module__ == "vegard"
        for member in own_names(thing) if name != "Error" else ():
            static = inspect.getattr_static(thing, member)
            words = static.__doc__ or ""
            # Beside the line that pybind11 writes itself.
            if not member.startswith("__"):
                assert words if isinstance(static, property) else len(words.splitlines()) > 1, f"{name}.{member}"


def test_arrays_say_their_shape():
    """Whatever a stub calls an array has a shape in its words."""
    for name, node in stub_names(STUBS.body).items():
        for member, stub in stub_names(node.body).items() if isinstance(node, ast.ClassDef) else ():
            if isinstance(stub, ast.FunctionDef) and "NDArray" in ast.unparse(stub.returns or ast.Constant("")):
                words = inspect.getattr_static(getattr(vegard, name), member).__doc__
                text = words + (getattr(vegard, name).__doc__ or "")
                assert re.search(r"\(\w+,|shape", text), f"{name}.{member}"
