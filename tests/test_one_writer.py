"""Files change in one module, and processes start in three."""

import ast
import re
from pathlib import Path

import tribo

ROOT = Path(tribo.__file__).parent
SOURCES = sorted([*ROOT.rglob("*.py"), *(ROOT.parent / "plugins").glob("*/src/**/*.py")])
WRITER = ROOT / "core" / "writing.py"
CHANGES = {"chmod", "makedirs", "mkdir", "mkfifo", "rename", "rmdir", "rmtree", "symlink_to"}
CHANGES |= {"touch", "truncate", "unlink", "write_bytes", "write_text", "tofile", "to_netcdf"}
CHANGES |= {"imsave"}
TO_PATH_OR_MEMORY = {"File", "savefig", "savetxt", "savez", "savez_compressed"}
TO_PATH_OR_MEMORY |= {"to_csv", "to_json", "to_html", "write_html", "ZipFile"}
READ = {"r", "rb"}


def called(node: ast.Call) -> tuple[str, str]:
    """Return what a call is on, and its name."""
    if isinstance(node.func, ast.Attribute):
        return ast.unparse(node.func.value), node.func.attr
    return "", getattr(node.func, "id", "")


def in_memory(tree: ast.AST) -> set[str]:
    """Names that a file gives to buffers."""
    return {
        ast.unparse(node.targets[0])
        for node in ast.walk(tree)
        if isinstance(node, ast.Assign)
        and isinstance(node.value, ast.Call)
        and called(node.value)[1] in ("BytesIO", "StringIO")
    }


def writes(node: ast.Call, buffers: set[str]) -> bool:
    """Whether a call changes a file or a folder, as far as its names tell."""
    owner, name = called(node)
    texts = [a.value for a in node.args if isinstance(a, ast.Constant) and isinstance(a.value, str)]
    modes = texts[1:] if owner == "" and len(texts) == len(node.args) else texts
    modes += [ast.unparse(k.value).strip("\"'") for k in node.keywords if k.arg == "mode"]
    first = ast.unparse(node.args[0]) if node.args else ""
    if name == "open":
        return (owner == "os" and first != "os.devnull") or bool(set(modes) - READ)
    if name == "replace":
        # A text has two arguments, and a dataclass keywords.
        return owner == "os" or (len(node.args) == 1 and not node.keywords and owner != "")
    if name in ("File", "open_hdf5"):
        return first not in buffers and bool(set(modes) - READ)
    if name == "ZipFile":
        return bool(set(modes) - READ)
    if name in TO_PATH_OR_MEMORY:
        return bool(first) and first not in buffers
    if name == "save":
        # Other objects save through the writer.
        return owner == "np" and first not in buffers
    return name in CHANGES or (name in ("remove", "copy", "move") and owner in ("os", "shutil"))


def found_writing(source: str) -> list[str]:
    """Return the calls of a source that change files."""
    tree = ast.parse(source)
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    buffers = in_memory(tree)
    return [ast.unparse(node) for node in calls if writes(node, buffers)]


def test_only_the_writer_writes():
    writing = {path for path in SOURCES if found_writing(path.read_text())}
    assert writing == {WRITER}


WRITING = """
open("a", "w"); open(path, mode="a"); path.open("wb"); path.write_text(text); path.replace(other)
path.unlink(); path.mkdir(); os.replace(a, b); os.open(a, flags); shutil.rmtree(a)
shutil.move(a, b); figure.savefig(path); np.save(path, a); np.savez_compressed(path, a=a)
table.to_csv(path); h5py.File(path, "w"); open_hdf5(path, "w"); zipfile.ZipFile(path, "w")
"""


def test_other_ways_to_write_are_found():
    calls = [call for line in WRITING.strip().splitlines() for call in line.split("; ")]
    assert found_writing(WRITING) == [call.replace('"', "'") for call in calls]


STARTS = {"subprocess", "multiprocessing", "ProcessPoolExecutor", "fork", "spawn"}


def test_processes_start_where_the_test_of_hostile_folders_looks():
    found = {
        path.relative_to(ROOT.parent).as_posix()
        for path in SOURCES
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Import | ast.ImportFrom | ast.Attribute)
        and STARTS & set(re.findall(r"\w+", ast.unparse(node)))
    }
    assert found == {
        "tribo/registry/child.py",
        "tribo/study/sweeping/executors.py",
    }
