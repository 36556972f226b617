"""One idea per file: no code file over 400 lines, no header over 200."""
import tree


def main():
    problems, count = [], 0
    for name in tree.files():
        suffix = "." + name.rpartition(".")[2]
        if name.rpartition("/")[2] in tree.GENERATED or (suffix not in tree.CODE and not name.endswith("CMakeLists.txt")
                                                         and not name.startswith(("tests/run", "deploy/", "tests/peers/"))):
            continue
        count += 1
        limit = 200 if suffix == ".h" else 400
        length = len(tree.lines(name))
        if length > limit:
            problems.append(f"{name}: {length} lines; at most {limit}: split it by ideas")
    tree.finish(problems, (count, "files"))


if __name__ == "__main__":
    main()
