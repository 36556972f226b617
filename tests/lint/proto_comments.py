"""The contract explains itself: each field, enum value and call of proto/ is commented.

The comment stands on the line itself, above it, above the run of lines without a blank one that it belongs to (a pair like width
and height), or above the whole message or enum, which then explains its members together.
"""
import re

import tree

BLOCK = re.compile(r"^\s*(message|enum|service|oneof)\s+\w+.*\{")
MEMBER = re.compile(r"^\s*(?:rpc\s+(\w+)|(?:(?:optional|repeated)\s+)?(?:[\w.]+\s+)?(\w+)\s*=\s*\d+\s*;)")


def main():
    problems, count = [], 0
    for name in tree.files("proto", suffixes={".proto"}):
        commented = False  # the line above is a comment, or belongs to a commented run
        blocks = []  # of the open braces, whether they are commented
        for number, line in tree.lines(name):
            text = line.strip()
            if text.startswith("//"):
                commented = True
                continue
            member = MEMBER.match(line)
            if member and not text.startswith(("reserved", "syntax")):
                count += 1
                if not (commented or "//" in line or (blocks and blocks[-1])):
                    problems.append(f"{name}:{number}: {member.group(1) or member.group(2)} has no comment: say what it means, "
                                    "its unit and its range")
            elif BLOCK.match(line) and not text.endswith("}"):
                # A service's comment says what it is for, not what each call does.
                blocks.append(commented and not text.startswith("service"))
                commented = False
            elif text == "}":
                blocks.pop()
                commented = False
            elif text == "":
                commented = False
    tree.finish(problems, (count, "fields, values and calls"))


if __name__ == "__main__":
    main()
