#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Make the classes, docstrings and stubs of the package from lua/lacuna.d.lua, which a test compares with the
program and the reference.

generate.py           write lacuna/_api.py, lacuna/_api.pyi, lacuna/synthetic.py and lacuna/synthetic.pyi
generate.py --check   only compare; exit code 1 where one differs
"""
import ast
import pathlib
import re
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
STUB = HERE.parent / "lua" / "lacuna.d.lua"
WIDTH = 110
# Classes whose objects stay in the interpreter, and what they have beyond Lua.
OBJECTS = {"Model": "Shown", "Face": "AnyFace", "Volume": "Shown", "Mesh": "AnyMesh", "Assembly": "Object",
           "AssemblyMesh": "AnyMesh", "QuadMesh": "AnyMesh", "Quality": "Object"}
SLOW = {"Model", "Quality"}  # some of their fields are worked out when they are asked for
# Not for Python: the command line, the errors of pcall, what numpy does.
LEFT_OUT = {"params", "Error", "Buffer", "Report", "AssemblyReport", "Synthetic"}
KEYWORDS = {"class", "with", "from", "in", "is", "not", "and", "or", "if", "for", "def", "import", "pass"}
PATHS = {"path", "from", "to", "file"}


# --- types of the Lua language server -----------------------------------------------------------------------

class Types:
    """Reads one type at the beginning of a text. A type is ("name", …), ("list", of), ("union", parts …),
    ("map", key, of), ("record", {name: (optional, type)}), ("tuple", parts …), ("literal", text) or
    ("function", parameters, result)."""

    def __init__(self, text):
        self.text = text
        self.at = 0

    def skip(self, pattern):
        found = re.compile(pattern).match(self.text, self.at)
        if found:
            self.at = found.end()
        return found

    def must(self, pattern):
        found = self.skip(pattern)
        if not found:
            raise SystemExit(f"{STUB}: no {pattern} at: {self.text[self.at:]}")
        return found

    def union(self):
        parts = [self.suffixed()]
        while self.skip(r"\|"):
            parts.append(self.suffixed())
        return parts[0] if len(parts) == 1 else ("union", *parts)

    def suffixed(self):
        found = self.single()
        while self.skip(r"\[\]"):
            found = ("list", found)
        return found

    def single(self):
        if self.skip(r"\("):
            found = self.union()
            self.must(r"\)")
            return found
        if self.skip(r"table<"):
            key = self.union()
            self.must(r",\s*")
            of = self.union()
            self.must(r">")
            return ("map", key, of)
        if self.skip(r"fun\("):
            parameters = []
            while self.skip(r"(\w+):\s*"):
                parameters.append(self.union())
                self.skip(r",\s*")
            self.must(r"\)")
            return ("function", parameters, self.union() if self.skip(r":\s*") else ("name", "nil"))
        if self.skip(r"\{\s*"):
            places, names = [], {}
            while not self.skip(r"\s*\}"):
                place = self.skip(r"\[\d+\]\??:\s*")
                if place:
                    places.append(self.union())
                else:
                    name = self.must(r"(\w+)(\??):\s*")
                    names[name[1]] = (bool(name[2]), self.union())
                self.skip(r"\s*,\s*")
            return ("tuple", *places) if places else ("record", names)
        literal = self.skip(r'"[^"]*"|\d+(\.\d+)?')
        if literal:
            return ("literal", literal[0])
        return ("name", self.must(r"\.\.\.|[\w.]+")[0])


def read_type(text):
    """@return the type, and the text behind it."""
    types = Types(text)
    found = types.union()
    return found, text[types.at:].strip()


# --- the stub -----------------------------------------------------------------------------------------------

class Class:
    def __init__(self, base, doc):
        self.base, self.doc = base, doc
        self.fields = {}  # name: (optional, type, text)
        self.methods = {}  # name: Function


class Function:
    def __init__(self, name, doc, params, returns):
        self.name, self.doc, self.params, self.returns = name, doc, params, returns


def read_stub(text):
    classes, aliases, doc, params, returns = {}, {}, [], [], []
    current = alias = field = None
    for line in text.splitlines():
        if line.startswith("---@class"):
            found = re.match(r"---@class lacuna(?:\.(\w+))?(?:: (?:lacuna\.)?([\w\[\]]+))?(?: (.*))?$", line)
            if found:  # not of another name
                current = classes.setdefault(found[1] or "lacuna", Class(found[2], " ".join(doc)))
            doc, field = [], None
        elif line.startswith("---@alias"):
            found = re.match(r"---@alias lacuna\.(\w+)\s*(.*)$", line)
            alias, doc, field = found[1], [], None
            aliases[alias] = read_type(found[2])[0] if found[2] else ("union",)
        elif line.startswith("---|"):
            aliases[alias] += tuple(("literal", word) for word in re.findall(r'"[^"]*"', line))
        elif line.startswith("---@field"):
            found = re.match(r"---@field (\[\d+\]|\w+)(\??) (.*)$", line)
            field = found[1]
            current.fields[field] = (bool(found[2]), *read_type(found[3]))
        elif line.startswith("---@param"):
            found = re.match(r"---@param (\w+)(\??) (.*)$", line)
            params.append((found[1], bool(found[2]), *read_type(found[3])))
        elif line.startswith("---@return"):
            rest = line[len("---@return "):]
            while rest:
                found, rest = read_type(rest)
                returns.append((found, rest))
                rest = rest.partition(", ")[2] if re.match(r"\w+, ", rest) else ""
        elif line.startswith("---@"):
            pass
        elif line.startswith("---") and field:
            optional, type_, text_ = current.fields[field]
            current.fields[field] = (optional, type_, text_ + " " + line[3:].strip())
        elif line.startswith("---"):
            doc.append(line[3:].strip())
        else:
            found = re.match(r"function (\w+)[.:](\w+)\(.*\) end", line)
            if found:
                owner = {"synthetic": "Synthetic"}.get(found[1], found[1])
                classes[owner].methods[found[2]] = Function(found[2], " ".join(doc), params, returns)
            doc, params, returns, field = [], [], [], None
    return classes, aliases


# --- in the words of Python ---------------------------------------------------------------------------------

def in_python(text):
    """A sentence on Lua as one on Python."""
    text = re.sub(r"\b(mesh|model|volume|assembly|Mesh|Model|Volume|Assembly):(\w+)", r"\1.\2", text)
    text = re.sub(r"open_volume\s*\{ (\w+) = (\S+) \}", r"open_volume(\1=\2)", text)
    text = re.sub(r"sweep\(options\)\.?:?write\(path\)", "sweep(...).write(path)", text)
    text = re.sub(r"\{ (\w+(?:, \w+)*) \}", r"[\1]", text)
    for lua, python in ("true", "True"), ("false", "False"), ("nil", "None"):
        text = re.sub(rf"\b{lua}\b", python, text)
    return text.replace("`[volume] = options` lays", "a dict `{volume: options}` before them lays")


def name_in_python(name):
    return name + "_" if name in KEYWORDS else name


class Language:
    def __init__(self, classes, aliases):
        self.classes, self.aliases = classes, aliases

    def fields(self, name):
        own = self.classes[name]
        base = self.fields(own.base) if own.base in self.classes else {}
        return {**base, **own.fields}

    def options(self, type_):
        """The fields that keywords give, None where the type has none."""
        kind = type_[0]
        if kind == "record":
            return {name: (optional, of, "") for name, (optional, of) in type_[1].items()}
        if kind == "union":
            for part in type_[1:]:
                found = self.options(part)
                if found is not None:
                    return found
        if kind == "name" and type_[1].startswith("lacuna."):
            name = type_[1][len("lacuna."):]
            if name in self.aliases:
                return self.options(self.aliases[name])
            fields = self.classes[name].fields
            if name not in OBJECTS and fields and "[1]" not in fields:
                return self.fields(name)
        return None

    def hint(self, type_, given, name=""):
        """A type for annotations; `given`: of an argument, not of a result."""
        kind = type_[0]
        if kind == "union":
            literals = [part[1] for part in type_[1:] if part[0] == "literal"]
            hints = [self.hint(part, given, name) for part in type_[1:] if part[0] != "literal"]
            if literals:
                hints.append(f"Literal[{', '.join(literals)}]" if "4.1" not in literals else "float")
            return " | ".join(dict.fromkeys(hints))
        if kind == "literal":
            return f"Literal[{type_[1]}]"
        if kind == "list":
            of = self.hint(type_[1], given, name)
            array = " | numpy.ndarray" if given and of in ("Vector", "Sequence[int]", "Iterable[int]") else ""
            return f"{'Iterable' if given else 'list'}[{of}]{array}"
        if kind == "tuple":
            hints = " | ".join(dict.fromkeys(self.hint(part, given) for part in type_[1:]))
            return f"{'Sequence' if given else 'list'}[{hints}]"
        if kind == "map":
            if not given and "MetricName" in str(type_[1]):  # see "rows" in `shape`
                return f"dict[MetricName, {self.hint(type_[2], given)}]"
            hints = ", ".join(self.hint(part, given) for part in type_[1:])
            return f"{'Mapping' if given else 'dict'}[{hints}]"
        if kind == "record":
            return "Mapping[str, Any]" if given else "Table"
        if kind == "function":
            return f"Callable[[{', '.join(self.hint(part, given) for part in type_[1])}], " \
                   f"{self.hint(type_[2], given)}]"
        word = type_[1]
        simple = {"number": "float", "integer": "int", "string": "str", "boolean": "bool", "nil": "None",
                  "table": "Any", "...": "Any"}
        if word == "string" and name in PATHS:
            return "Path"
        if word in simple:
            return simple[word]
        word = word.removeprefix("lacuna.")
        if word in self.aliases and not given and word == "Vector":
            return "list[float]"
        if word in self.aliases or word in OBJECTS:
            return word
        if word == "Buffer":
            return "numpy.ndarray"
        if word in ("Report", "AssemblyReport"):
            return "Report"
        if given:
            return "Mapping[str, Any]" if "[1]" not in self.classes[word].fields else "Sequence[Any]"
        return word

    def words(self, type_, given=True):
        """The type as a docstring has it."""
        text = self.hint(type_, given)
        text = re.sub(r"Literal\[([^]]*)\]", lambda found: found[1].replace(", ", " | "), text)
        text = text.replace("Mapping[str, Any]", "dict").replace("Mapping[", "dict[")
        text = re.sub(r"\bVector\b", "(x, y, z)", text.replace("Sequence[", "list[").replace("Iterable[", "list["))
        for name, alias in self.aliases.items():
            if re.search(rf"\b{name}\b", text):
                short = "str" if len(alias) > 9 else self.words(alias, given)
                text = re.sub(rf"\b{name}\b", lambda _: short, text)
        return text

    def shape(self, type_):
        """How a result is to be shaped; see `shaped` in _objects.py."""
        kind = type_[0]
        if kind == "list":
            of = self.shape(type_[1])
            return ("list", of) if of else None
        if kind == "map":
            of = self.shape(type_[2])
            by_number = "integer" in str(type_[1])
            if by_number and "MetricName" in str(type_[1]):
                return ("rows", of)
            return ("map", of) if of or by_number else None
        if kind == "record":
            inner = {name: self.shape(of) for name, (_, of) in type_[1].items()}
            if any(inner.values()):
                raise SystemExit(f"{STUB}: give {type_} a class of its own")
            return None
        if kind == "name" and type_[1].startswith("lacuna."):
            word = type_[1][len("lacuna."):]
            if word in self.classes and word not in OBJECTS and word not in LEFT_OUT:
                return ("of", word)
        return None

    def is_buffer(self, function):
        return function.returns and function.returns[0][0] == ("name", "lacuna.Buffer")

    def result(self, function):
        if not function.returns:
            return "None"
        if len(function.returns) == 1 and function.returns[0][0] == ("name", "integer") \
                and function.returns[0][1].startswith("..."):
            return "tuple[int, ...]"
        hints = [self.hint(type_, False) for type_, _ in function.returns]
        if function.returns[0][0] == ("name", "table") and function.returns[0][1] == "report":
            return "Report"
        return hints[0] if len(hints) == 1 else f"tuple[{', '.join(hints)}]"

    def signature(self, function, method):
        """Parameters of the stub and of the code, the arguments that are passed on, and options for the
        docstring."""
        stub, code, arguments, listed = (["self"], ["self"], [], []) if method else ([], [], [], [])
        for name, optional, type_, text in function.params:
            options = self.options(type_)
            name = name_in_python(name)
            if options is None:
                default = " = None" if optional else ""
                other = " | OtherMesh" if function.name == "load" else ""
                stub.append(f"{name}: {self.hint(type_, True, name.rstrip('_'))}{other}"
                            f"{' | None = None' if optional else ''}")
                code.append(name + default.replace(" ", ""))
                arguments.append(name)
                if text:
                    listed.append((name, text))
                continue
            required = [key for key, (may_lack, *_) in options.items() if not may_lack]
            if name in ("which", "options", "selector", "roles", "face"):
                for key in required:
                    stub.append(f"{key}: {self.hint(options[key][1], True)}")
                    code.append(key)
            if not required:
                other = name == "which" or type_[0] == "union"
                kind = self.hint(type_, True) if other else "Mapping[str, Any]"
                stub.append(f"{name}: {kind} | None = None")
                code.append(f"{name}=None")
            stub += ["/"] if not required else []
            code += ["/"] if not required else []
            others = [key for key in options if key not in required]
            if others:
                stub.append("*")
                stub += [f"{name_in_python(key)}: {self.hint(options[key][1], True)} | None = ..."
                         for key in others]
            code.append("**keywords")
            first = "None" if required else name
            passed = "".join(f", {key}={key}" for key in required)
            if name == "which":
                arguments.append("options_of(which, keywords) if keywords else which")
            else:
                arguments.append(f"options_of({first}, keywords{passed})")
            if type_[0] != "record" and text:
                listed.append(("", text))
            listed += [self.entry(key, of, text_) for key, (_, of, text_) in options.items()]
            listed += self.nested(options)
        return stub, code, arguments, listed

    def entry(self, name, type_, text, given=True):
        """A line of a docstring: name, type, meaning."""
        return name_in_python(name), f"{self.words(type_, given)}{'; ' + text if text else ''}"

    def nested(self, options):
        """Keys of the tables among the options."""
        found, seen = [], set()
        for key, (_, type_, _) in options.items():
            for word in re.findall(r"lacuna\.(\w+)", str(type_)):
                if word in seen or word in OBJECTS or word in self.aliases:
                    continue
                seen.add(word)
                if word == "Interval":
                    found.append(("", f"One of `{key}`: {self.classes[word].doc}"))
                    continue
                found.append(("", f"A dict for `{key}` has:"))
                found += [self.entry(name, of, text) for name, (_, of, text) in self.fields(word).items()]
        return found


def wrapped(text, indent, further=None):
    return textwrap.fill(in_python(text), WIDTH, initial_indent=indent, subsequent_indent=further or indent,
                         break_long_words=False, break_on_hyphens=False)


def docstring(text, listed, indent):
    """A docstring: the text, then the options, a line each."""
    text = in_python(text)
    parts = [textwrap.fill(text, WIDTH, initial_indent=indent + '"""', subsequent_indent=indent) if text else
             indent + '"""']
    for name, words in listed:
        if name == "":
            parts += ["", wrapped(words, indent)]
        else:
            if len(parts) == 1 and text:
                parts.append("")
            parts.append(wrapped(f"{name}: {words}", indent, indent + "    "))
    if len(parts) == 1:
        return parts[0] + '"""' if text else ""
    if not text:  # no empty first line
        parts = [indent + '"""' + parts[1].lstrip()] + parts[2:]
    return "\n".join(parts) + "\n" + indent + '"""'


def fold(head, items, tail, indent):
    """`head(items)tail` in lines that are not too long."""
    line = f"{indent}{head}({', '.join(items)}){tail}"
    if len(line) <= WIDTH:
        return line
    lines = [indent + "       "]
    for item in items:
        if len(lines[-1]) + len(item) + 2 > WIDTH and lines[-1].strip():
            lines.append(indent + "       ")
        lines[-1] += f" {item},"
    return f"{indent}{head}(\n" + "\n".join(lines) + f"\n{indent}){tail}"


HEAD = '''# SPDX-License-Identifier: MIT
# Made by python/generate.py from lua/lacuna.d.lua.
'''


class Writer:
    def __init__(self, language):
        self.language = language
        self.code, self.stub = [], []

    def function(self, function, owner, indent):
        language = self.language
        stub, code, arguments, listed = language.signature(function, owner == "method")
        self.stub.append(fold(f"def {function.name}", stub, f" -> {language.result(function)}: ...", indent))
        doc = function.doc
        if function.returns and function.returns[0][1] and function.returns[0][1] not in ("self", "report") \
                and not re.match(r"^[\w.]+(,|$)", function.returns[0][1]) and not doc:
            doc = "Returns " + function.returns[0][1]
        if function.name == "load" and not owner:
            doc += " In the place of a path: a mesh of meshio or PyVista."
        lines = [fold(f"def {function.name}", code, ":", indent)]
        text = docstring(doc, listed, indent + "    ")
        if text:
            lines.append(text)
        if owner == "method":
            call = "self._array" if language.is_buffer(function) else "self._method"
            name = f'"{function.name}"'
        else:
            call, name = "call", f'"module", "{owner}{function.name}"'
        made = f"{call}({', '.join([name] + arguments)})"
        if function.name == "load" and not owner:
            made = f"loaded({', '.join(arguments)})"
        shape = language.shape(function.returns[0][0]) if function.returns else None
        if shape:
            made = f"shaped({made}, {shape})"
        lines.append(f"{indent}    return {made}" if function.returns else f"{indent}    {made}")
        self.code.append("\n".join(lines))

    def object_class(self, name):
        language, own = self.language, self.language.classes[name]
        head = f"class {name}({OBJECTS[name]}):"
        self.stub.append(head)
        self.code.append(head + "\n" + (docstring(own.doc, [], "    ") + "\n\n" if own.doc else "")
                         + "    __slots__ = ()" + ("\n    _at_once = False" if name in SLOW else ""))
        for field, (optional, type_, text) in own.fields.items():
            shown = name_in_python(field)
            kind = language.hint(type_, False) + (" | None" if optional else "")
            self.stub.append(f"    @property\n    def {shown}(self) -> {kind}: ...")
            made = f'self._field("{field}")'
            shape = language.shape(type_)
            if shape:
                made = f"shaped({made}, {shape})"
            text = docstring(text, [], "        ")
            self.code.append(f"    @property\n    def {shown}(self):\n{text + chr(10) if text else ''}"
                             f"        return {made}")
        for function in own.methods.values():
            self.function(function, "method", "    ")

    def record(self, name):
        language, own = self.language, self.language.classes[name]
        fields = language.fields(name)
        self.stub.append(f"class {name}(Table):")
        self.stub += [f"    {name_in_python(field)}: {language.hint(type_, False)}"
                      f"{' | None' if optional else ''}" for field, (optional, type_, _) in fields.items()]
        listed = [language.entry(field, type_, text, False) for field, (_, type_, text) in fields.items()]
        shapes = {field: language.shape(type_) for field, (_, type_, _) in fields.items()}
        shapes = {field: shape for field, shape in shapes.items() if shape}
        lacking = [field for field, (optional, _, _) in fields.items() if optional]
        lacking = textwrap.fill(f"    _optional = {lacking}", WIDTH, subsequent_indent=" " * 17)
        self.code.append(f"class {name}(Table):\n{docstring(own.doc, listed, '    ')}\n\n    __slots__ = ()\n"
                         f"    _shapes = {shapes}\n{lacking}")


def results(language):
    """Names of the classes that results have, nested ones too."""
    found = []

    def visit(type_):
        for word in re.findall(r"lacuna\.(\w+)", str(type_)):
            if word in language.classes and word not in {*OBJECTS, *LEFT_OUT, *found}:
                found.append(word)
                for _, inner, _ in language.fields(word).values():
                    visit(inner)

    for name in [*OBJECTS, "lacuna"]:
        for _, type_, _ in language.classes[name].fields.values():
            visit(type_)
        for function in language.classes[name].methods.values():
            for type_, _ in function.returns:
                visit(type_)
    return found


def make():
    """@return the text of every file, by name."""
    language = Language(*read_stub(STUB.read_text()))
    whole = language.classes["WriteOptions"]  # of an assembly `quality` is an error
    own = language.classes["AssemblyWriteOptions"] = Class(whole.base, whole.doc)
    own.fields = {name: field for name, field in whole.fields.items() if name != "quality"}
    write = language.classes["AssemblyMesh"].methods["write"]
    write.params[-1] = (*write.params[-1][:2], ("name", "lacuna.AssemblyWriteOptions"), write.params[-1][3])
    api = Writer(language)
    for name in results(language):
        api.record(name)
    for name in OBJECTS:
        api.object_class(name)
    functions = [name for name in language.classes["lacuna"].methods if name not in LEFT_OUT]
    for name in functions:
        api.function(language.classes["lacuna"].methods[name], "", "")
    names = [*results(language), *OBJECTS, *functions]
    exported = fold("__all__ = ", [f'"{name}"' for name in names], "", "").replace("(", "[", 1)[:-1] + "]"
    table = "classes.update(" + ", ".join(f"{name}={name}" for name in [*results(language), *OBJECTS]) + ")"
    table = textwrap.fill(table, WIDTH, subsequent_indent="               ") \
        + '\n\nfor made in classes.values():\n    made.__module__ = "lacuna"'
    code = HEAD + '"""Classes and functions, as lacuna.d.lua has them."""\n' \
        "from ._objects import (AnyFace, AnyMesh, Object, Shown, Table, call, classes, loaded,\n" \
        "                       options_of, shaped)\n\n" + exported
    aliases = "\n".join(f"{name} = Union[{language.hint(type_, True).replace(' | ', ', ')}"
                        f"{', numpy.ndarray' if name == 'Vector' else ''}]"
                        for name, type_ in language.aliases.items() if name != "Drop")
    stub = HEAD + "import os\nfrom collections.abc import Callable, Iterable, Mapping, Sequence\n" \
        "from typing import Any, Literal, Protocol, Union\n\nimport numpy\n\n" \
        "from ._objects import AnyFace, AnyMesh, Object, Shown\nfrom ._wire import Report, Table\n\n" \
        "class OtherMesh(Protocol):  # of meshio or PyVista\n    points: Any\n\n" \
        "Path = Union[str, os.PathLike[str]]\n" + aliases + "\n"
    synthetic = Writer(language)
    for function in language.classes["Synthetic"].methods.values():
        synthetic.function(function, "synthetic.", "")
    doc = '"""Open volumes of any class and size, for trials: models whose faces have names."""\n'
    head = "from collections.abc import Iterable, Mapping\nfrom typing import Any, Union\n\n" \
        "from ._api import Model\n\nDrop = Union[str, Iterable[str]]\n\n"
    return {
        "_api.py": code + "\n\n\n" + spaced(api.code) + "\n\n\n" + table + "\n",
        "_api.pyi": stub + "\n" + "\n".join(api.stub) + "\n",
        "synthetic.py": HEAD + doc + "from ._objects import call, options_of\n\n\n"
        + spaced(synthetic.code) + "\n",
        "synthetic.pyi": HEAD + head + "\n".join(synthetic.stub) + "\n",
    }


def spaced(parts):
    """Two lines between functions and classes, one between methods."""
    text = parts[0]
    for part in parts[1:]:
        text += ("\n\n" if part.startswith("    ") else "\n\n\n") + part
    return text


def main():
    wrong = []
    for name, text in make().items():
        path = HERE / "lacuna" / name
        ast.parse(text)
        if "--check" not in sys.argv[1:]:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            wrong.append(name)
    if wrong:
        raise SystemExit(f"python/lacuna: {', '.join(wrong)} are not as lua/lacuna.d.lua says; "
                         "run python/generate.py")


if __name__ == "__main__":
    main()
