# One static library per folder: radiata_library(io base model) makes radiata_io from io/*.cpp.
# What a library links states what it may include; tests/lint reads the includes and holds them against the same order.
function(radiata_library name)
    string(REPLACE "/" "_" target radiata_${name})
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/server/${name}/*.cpp)
    if(sources)
        add_library(${target} STATIC ${sources})
        set(scope PUBLIC)
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
