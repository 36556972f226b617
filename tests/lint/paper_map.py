"""docs/paper_map.md names only what is there: each `path/...` in it exists, each `Suite.Test` is in tests/list.txt (a name ending
in * stands for all that begin so), and each `lab NAME` is an experiment of radiata-lab.
"""
import re

import tree

MAP = "docs/paper_map.md"
TEST = re.compile(r"^[A-Za-z][\w/]*\.[\w/.*-]+$")
PATH = re.compile(r"^(server|shaders|client|tests|docs|proto|deploy|cmake)/[\w./*-]+$")


def experiments():
    """The words in quotes of the measuring program's sources; an experiment's name is one of them."""
    text = "".join((tree.ROOT / name).read_text() for name in tree.files("server/tools", "server/lab", suffixes={".cpp", ".h"}))
    return set(re.findall(r'"([a-z0-9-]+)"', text))


def main():
    tests = (tree.ROOT / "tests/list.txt").read_text().split("\n")
    labs = experiments()
    problems, count = [], 0
    for number, line in tree.lines(MAP):
        for name in re.findall(r"`([^`]+)`", line):
            where = f"{MAP}:{number}: {name}"
            if PATH.match(name):
                count += 1
                if not any(tree.ROOT.glob(name)):
                    problems.append(f"{where} is not there")
            elif name.startswith("lab "):
                count += 1
                if name[4:] not in labs:
                    problems.append(f"{where}: radiata-lab has no such experiment")
            elif TEST.match(name):
                count += 1
                if not any(test == name or (name.endswith("*") and test.startswith(name[:-1])) for test in tests):
                    problems.append(f"{where} is no test of tests/list.txt")
    tree.finish(problems, (count, "names"))


if __name__ == "__main__":
    main()
