# Headers that most files include anyway are compiled once; each file still names what it uses (the fuzzers are built without).
# Targets of one kind (library or program) share one, which must be made with the fewest definitions of them all: radiata_precompiled(TARGET HEADERS...) makes it, radiata_reuses(TARGET OWNER)
# takes it.
set(RADIATA_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <random> <span>
    <string> <vector> <glm/glm.hpp>)
function(radiata_precompiled target)
    if(NOT RADIATA_FUZZ)
        target_precompile_headers(${target} PRIVATE ${RADIATA_COMMON_HEADERS} ${ARGN})
    endif()
endfunction()
function(radiata_reuses target owner)
    if(NOT RADIATA_FUZZ AND NOT target STREQUAL owner)
        target_precompile_headers(${target} REUSE_FROM ${owner})
    endif()
endfunction()

# For folders whose own code is never what takes the time of a run (programs, clients, tests: the work is in the libraries and
# shaders): -O1 compiles a fifth faster than -O2. Precompiled headers are shared within such a folder only.
macro(radiata_compile_fast)
    add_compile_options($<$<CONFIG:Release>:-O1>)
endmacro()

# One static library per folder: radiata_library(io base model) makes radiata_io from io/*.cpp.
# What a library links states what it may include; tests/lint reads the includes and holds them against the same order.
function(radiata_library name)
    string(REPLACE "/" "_" target radiata_${name})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/server/${name}/*.cpp)
    if(sources)
        add_library(${target} STATIC ${sources})
        set(scope PUBLIC)
        if(name STREQUAL base)
            radiata_precompiled(${target})
        elseif(NOT name MATCHES "^(gpu|service)$")
            radiata_reuses(${target} radiata_base)
        endif()
    else()
        add_library(${target} INTERFACE)
        set(scope INTERFACE)
    endif()
    # The root too: structs that shaders read are included as "shaders/shared/....glsl".
    target_include_directories(${target} ${scope} ${CMAKE_SOURCE_DIR}/server ${CMAKE_SOURCE_DIR})
    foreach(dependency IN LISTS ARGN)
        target_link_libraries(${target} ${scope} ${dependency})
    endforeach()
endfunction()
