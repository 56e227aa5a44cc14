"""No class with member functions has more than 20 data members. Counted are those of nested structs
and of structs without functions that the same file declares and that this class alone holds.

Reads the sources as text: a statement of a class body is a data member unless it is a function, an
alias, a friend, a static or an enumeration. Prints every class above the limit and exits 1.
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIMIT = 20
SKIPPED = re.compile(r"^(using|friend|typedef|static|enum|template|explicit|virtual|operator|public|private|"
                     r"protected|constexpr static|inline static|extern|#)")


def without_comments(text):
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.S)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    return re.sub(r"^\s*#(?:[^\n\\]|\\\n|\\.)*", "", text, flags=re.M)


def body_at(text, start):
    """The text between the brace at `start` and its partner, and the place behind it."""
    depth = 0
    for k in range(start, len(text)):
        depth += (text[k] == "{") - (text[k] == "}")
        if depth == 0:
            return text[start + 1 : k], k + 1
    return "", len(text)


CLASS = re.compile(r"\b(class|struct)\s+(?:\[\[[^\]]*\]\]\s*)?([A-Za-z_]\w*)(?:\s+final)?\s*(?::[^:;{][^;{]*)?\{")


ACCESS = re.compile(r"\b(public|private|protected)\s*:(?!:)")
MEMBER = re.compile(r"(?:(?:mutable|const)\s+)*(?:std::optional\s*<\s*)?([A-Za-z_]\w*)\b[^()]*$")


def members_of(body, types=None):
    """(data members, member functions) of a class body; nested classes count with their members.
    Adds the type of each data member to the set `types`, which may be missing."""
    body = ACCESS.sub("", body)  # else the struct behind one is not taken for a nested one
    data, functions, at, piece = 0, 0, 0, ""
    while at < len(body):
        nested = CLASS.match(body, at)
        if nested and not piece.strip():
            inside, at = body_at(body, nested.end() - 1)
            data += members_of(inside)[0]
            declared = re.match(r"\s*([\w,\s]*);", body[at:])  # struct { ... } a, b;
            if declared:
                at += declared.end()
            continue
        letter = body[at]
        if letter == "{":
            inside, behind = body_at(body, at)
            if "(" in piece.split("=")[0]:
                functions += 1
                piece, at = "", behind
                if body[at : at + 1] == ";":
                    at += 1
                continue
            piece, at = piece + "{}", behind
            continue
        if letter == ";":
            text = " ".join(piece.split())
            head = re.sub(r"<[^<>]*(<[^<>]*(<[^<>]*>[^<>]*)*>[^<>]*)*>", "", text)
            if not text or SKIPPED.match(text):
                pass
            elif "(" in head.split("=")[0].split("{")[0] and "(*" not in head:
                functions += 1
            else:
                data += len(re.sub(r"\{[^}]*\}|\([^)]*\)|=[^,]*", "", head).split(","))
                type_of = MEMBER.match(text.split("=")[0])
                if types is not None and type_of:
                    types.add(type_of[1])
            piece, at = "", at + 1
            continue
        piece, at = piece + letter, at + 1
    return data, functions


class Declared:
    """A class outside of other classes."""

    def __init__(self, file, name, body):
        self.file, self.name, self.types = file, name, set()
        self.data, self.functions = members_of(body, self.types)


def classes_of(file, text):
    text, at = without_comments(text), 0
    while found := CLASS.search(text, at):
        body, at = body_at(text, found.end() - 1)
        yield Declared(file, found[2], body)


def above_limit(classes):
    """Returns (class, data members) of each class with functions and too many data members."""
    structs = {(c.file, c.name): c for c in classes if not c.functions}
    holders = {}
    for c in classes:
        for name in c.types:
            holders.setdefault(name, set()).add((c.file, c.name))

    def total(c):
        parts = [structs[c.file, name] for name in c.types
                 if (c.file, name) in structs and holders[name] == {(c.file, c.name)} and name != c.name]
        return c.data + sum(total(part) for part in parts)

    return [(c, total(c)) for c in classes if c.functions and total(c) > LIMIT]


def must_find_hidden_members():
    """State of a class is counted behind an access specifier and in a struct before the class."""
    eleven = "int " + ", ".join(f"v{k}" for k in range(11)) + ";"
    nested = f"class A {{ void f(); private: struct B {{ {eleven} }}; B b; {eleven} }};"
    before = f"struct B {{ {eleven} }}; class A {{ void f(); {eleven} B b = {{}}; }};"
    for text in nested, before, before.replace("B b", "std::optional<B> b"):
        assert len(above_limit(list(classes_of("a.h", text)))) == 1, text
    shared = before + " class C { void f(); B b; };"
    assert not above_limit(list(classes_of("a.h", shared))), shared


def main():
    must_find_hidden_members()
    files = subprocess.run(["git", "ls-files", "*.h", "*.hpp", "*.cpp"], cwd=ROOT, capture_output=True,
                           text=True, check=True).stdout.split()
    classes = [c for name in files for c in classes_of(name, (ROOT / name).read_text(encoding="utf-8"))]
    large = [f"{c.file}: {c.name} has {total} data members" for c, total in above_limit(classes)]
    print(*large, sep="\n")
    print(f"{len(classes)} classes and structs, {len(large)} above {LIMIT} data members")
    sys.exit(1 if large or len(classes) < 500 else 0)


if __name__ == "__main__":
    main()
