"""Data flows one way: who may include whom.

server/: a library may include itself and what its line in CMakeLists.txt links, directly or not; and those lines must keep the
order below. Protobuf and gRPC only in service, tools and the clients; Vulkan only in gpu, store and render; the rooms of render
do not know each other, only frame knows them all; reference is written by other methods than the shaders and shares no code
with them, nor with the fast SH evaluation that feeds the shaders' data.
shaders/: rooms include shared/ and common/ and themselves.
"""
import posixpath
import re

import tree

# Left to right; a library links only libraries of earlier groups.
ORDER = [{"base"}, {"math"}, {"model"}, {"io", "build", "plan", "reference", "encode", "gpu"}, {"ingest"}, {"store"},
         {"render/glyph", "render/fiblet", "render/isosurface", "render/light"}, {"render/frame"}, {"session"}, {"service"}]
# Programs are no libraries. The measuring program runs where there is no gRPC.
TOOLS = {"tools": lambda table: set(table) | {"tools"}, "tools/lab": lambda table: set(table) - {"service", "session"} | {"tools/lab"}}
# Which libraries may include these headers.
PROTOBUF = (r"(google/protobuf|grpc|grpcpp|grpc\+\+|radiata/v1)/", {"service", "tools"})
VULKAN = (r"(vulkan/|volk\.h|vk_video/)", {"gpu", "store", "render/glyph", "render/fiblet", "render/isosurface", "render/light", "render/frame"})
# Headers that anybody may include from there: structs that C++ and GLSL share, and the embedded modules.
SHADER_HEADERS = {"model": r"shaders/shared/", "build": r"shaders/shared/", "ingest": r"shaders/shared/", "plan": r"shaders/shared/", "store": r"shaders/", "render": r"shaders/", "tools": r"shaders/"}
REFERENCE_MAY = r"(reference/|model/|base/|glm/|math/(?!sh_evaluate|polar|sh_rotation))"
CLIENT_MAY = r"(common|cli|load|base|math|model|io)/"
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]')


def links():
    """Library -> the libraries it links, from the CMake files."""
    table = {}
    for name in tree.files("server"):
        if not name.endswith("CMakeLists.txt"):
            continue
        text = "\n".join(line.split("#")[0] for _, line in tree.lines(name))
        for library, rest in re.findall(r"radiata_library\((\S+)([^)]*)\)", text):
            table[library] = {word[len("radiata_"):].replace("render_", "render/") for word in rest.split()
                              if word.startswith("radiata_") and word not in ("radiata_proto", "radiata_shaders")}
    return table


def closure(table, library):
    seen, todo = set(), {library}
    while todo:
        one = todo.pop()
        seen.add(one)
        todo |= table.get(one, set()) - seen
    return seen


def library_of(path, table):
    """The library a path under server/ belongs to, or None."""
    folder = posixpath.dirname(path)
    return folder if folder in table or folder in TOOLS else None


def check_server(table, name):
    inside = name[len("server/"):]
    own = library_of(inside, table)
    if own is None:
        yield f"{name}: the folder is no library of server/CMakeLists.txt"
        return
    allowed = TOOLS[own](table) if own in TOOLS else closure(table, own)
    room = own.split("/")[0]
    for number, bracket, header in includes(name):
        where = f"{name}:{number}: includes {header}"
        for pattern, who in (PROTOBUF, VULKAN):
            if re.match(pattern, header) and own not in who:
                yield f"{where}; only {', '.join(sorted(who))} may"
        target = library_of(header, table)
        if target is not None and target not in allowed:
            yield f"{where}; {own} may include {', '.join(sorted(allowed))} only"
        if header.startswith("shaders/") and not re.match(SHADER_HEADERS.get(room, r"$^"), header):
            yield f"{where}; {own} has nothing to do with shaders"
        if own == "reference" and bracket == '"' and not re.match(REFERENCE_MAY, header):
            yield f"{where}; the reference shares no code with what it is measured against"


def check_shader(name):
    room = name.split("/")[1]
    for number, bracket, header in includes(name):
        if bracket == "<":
            continue  # for C++, in structs that both read
        if not header.startswith("shaders/"):
            if "/" in header:
                yield f"{name}:{number}: includes {header}; write paths from the root"
            continue  # generated for a layout
        other = header.split("/")[1]
        allowed = {"shared"} if room == "shared" else {"shared", "common"} if room == "common" else {"shared", "common", room}
        if room == "test":
            allowed |= {"glyph", "isosurface", "frame"}
        if other not in allowed:
            yield f"{name}:{number}: includes {header}; shaders/{room} may include {', '.join(sorted(allowed))} only"


def check_client(name):
    for number, bracket, header in includes(name):
        if bracket == '"' and not re.match(CLIENT_MAY, header) and not re.match(PROTOBUF[0], header):
            yield f"{name}:{number}: includes {header}; clients know model and the contract, nothing else of the server"
        if re.match(VULKAN[0], header):
            yield f"{name}:{number}: includes {header}; clients have no device"


def includes(name):
    for number, line in tree.lines(name):
        found = INCLUDE.match(line)
        if found:
            yield number, found.group(1), found.group(2)


def main():
    table = links()
    rank = {library: i for i, group in enumerate(ORDER) for library in group}
    problems, count = [], 0
    for library, linked in sorted(table.items()):
        if library not in rank:
            problems.append(f"server/CMakeLists.txt: {library} has no place in the order of tests/lint/layers.py")
        for other in sorted(linked):
            if rank.get(other, 99) >= rank.get(library, 99):
                problems.append(f"server/CMakeLists.txt: {library} links {other}, which does not stand before it")
    for name in tree.files("server", "shaders", "client", suffixes={".cpp", ".h", ".glsl", ".comp"}):
        count += 1
        check = {"server": lambda n: check_server(table, n), "shaders": check_shader, "client": check_client}[name.split("/")[0]]
        if name.endswith((".cpp", ".h")) and name.startswith("shaders/"):
            continue
        problems += check(name)
    tree.finish(problems, (count, "files"))


if __name__ == "__main__":
    main()
