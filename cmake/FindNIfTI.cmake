# NIfTI::NIfTI: the NIfTI-1/2 reference library. The static one, so that radiata-lab needs no shared library of it.
find_package(ZLIB QUIET)
find_path(NIfTI_INCLUDE_DIR nifti2_io.h PATH_SUFFIXES nifti)
find_library(NIfTI_LIBRARY NAMES libnifti2.a nifti2)
find_library(NIfTI_ZNZ_LIBRARY NAMES libznz.a znz)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(NIfTI REQUIRED_VARS NIfTI_LIBRARY NIfTI_ZNZ_LIBRARY NIfTI_INCLUDE_DIR ZLIB_FOUND)
if(NIfTI_FOUND AND NOT TARGET NIfTI::NIfTI)
    add_library(NIfTI::NIfTI UNKNOWN IMPORTED)
    set_target_properties(NIfTI::NIfTI PROPERTIES
        IMPORTED_LOCATION ${NIfTI_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${NIfTI_INCLUDE_DIR}
        INTERFACE_LINK_LIBRARIES "${NIfTI_ZNZ_LIBRARY};ZLIB::ZLIB")
endif()
