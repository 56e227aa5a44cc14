"""No class with member functions has more than 20 data members, those of nested structs counted.

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


def members_of(body):
    """(data members, member functions) of a class body; nested classes count with their members."""
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
            text = re.sub(r"^((public|private|protected)\s*:\s*)+", "", text)
            head = re.sub(r"<[^<>]*(<[^<>]*(<[^<>]*>[^<>]*)*>[^<>]*)*>", "", text)
            if not text or SKIPPED.match(text):
                pass
            elif "(" in head.split("=")[0].split("{")[0] and "(*" not in head:
                functions += 1
            else:
                data += len(re.sub(r"\{[^}]*\}|\([^)]*\)|=[^,]*", "", head).split(","))
            piece, at = "", at + 1
            continue
        piece, at = piece + letter, at + 1
    return data, functions


def main():
    files = subprocess.run(["git", "ls-files", "*.h", "*.hpp", "*.cpp"], cwd=ROOT, capture_output=True,
                           text=True, check=True).stdout.split()
    counted, large = 0, []
    for name in files:
        text = without_comments((ROOT / name).read_text(encoding="utf-8"))
        for found in CLASS.finditer(text):
            data, functions = members_of(body_at(text, found.end() - 1)[0])
            counted += 1
            if functions and data > LIMIT:
                large.append(f"{name}: {found[2]} has {data} data members")
    print(*large, sep="\n")
    print(f"{counted} classes and structs, {len(large)} above {LIMIT} data members")
    sys.exit(1 if large or counted < 500 else 0)


if __name__ == "__main__":
    main()
