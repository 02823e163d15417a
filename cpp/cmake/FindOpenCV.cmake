# OpenCV by its modules: find_package(OpenCV COMPONENTS core imgproc …) gives the targets opencv_core, opencv_imgproc, …,
# OpenCV_INCLUDE_DIRS and OpenCV_VERSION, as OpenCV's own configuration does.
#
# That configuration is used where it is installed. Debian packs it into libopencv-dev, which needs a gigabyte of other
# packages; the headers and libraries of a module are in libopencv-MODULE-dev, and are found here without it.
set(required "")
set(optional "")
foreach(module IN LISTS OpenCV_FIND_COMPONENTS)
  if(OpenCV_FIND_REQUIRED_${module})
    list(APPEND required ${module})
  else()
    list(APPEND optional ${module})
  endif()
endforeach()
find_package(OpenCV ${OpenCV_FIND_VERSION} CONFIG QUIET COMPONENTS ${required} OPTIONAL_COMPONENTS ${optional})
if(OpenCV_FOUND)
  return()
endif()

include(FindPackageHandleStandardArgs)
find_path(OpenCV_INCLUDE_DIR opencv2/core/version.hpp PATH_SUFFIXES opencv5 opencv4)
mark_as_advanced(OpenCV_INCLUDE_DIR)

unset(OpenCV_VERSION)
if(OpenCV_INCLUDE_DIR)
  file(STRINGS "${OpenCV_INCLUDE_DIR}/opencv2/core/version.hpp" lines REGEX "^#define CV_VERSION_(MAJOR|MINOR|REVISION) ")
  string(REGEX MATCHALL "[0-9]+" numbers "${lines}")
  list(JOIN numbers "." OpenCV_VERSION)
endif()

# A module is there if both its header and its library are.
foreach(module IN LISTS OpenCV_FIND_COMPONENTS)
  find_path(OpenCV_${module}_INCLUDE_DIR opencv2/${module}.hpp HINTS "${OpenCV_INCLUDE_DIR}" NO_DEFAULT_PATH)
  find_library(OpenCV_${module}_LIBRARY opencv_${module})
  mark_as_advanced(OpenCV_${module}_INCLUDE_DIR OpenCV_${module}_LIBRARY)
  if(OpenCV_${module}_INCLUDE_DIR AND OpenCV_${module}_LIBRARY)
    set(OpenCV_${module}_FOUND TRUE)
  else()
    set(OpenCV_${module}_FOUND FALSE)
  endif()
endforeach()

find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR VERSION_VAR OpenCV_VERSION HANDLE_COMPONENTS
  REASON_FAILURE_MESSAGE "each module's headers and library are needed (Debian: libopencv-MODULE-dev)")
if(NOT OpenCV_FOUND)
  return()
endif()

set(OpenCV_INCLUDE_DIRS "${OpenCV_INCLUDE_DIR}")
set(OpenCV_LIBS "")
foreach(module IN LISTS OpenCV_FIND_COMPONENTS)
  if(NOT OpenCV_${module}_FOUND)
    continue()
  endif()
  if(NOT TARGET opencv_${module})
    add_library(opencv_${module} UNKNOWN IMPORTED)
    set_target_properties(opencv_${module} PROPERTIES
      IMPORTED_LOCATION "${OpenCV_${module}_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${OpenCV_INCLUDE_DIR}")
    if(NOT module STREQUAL "core")
      find_library(OpenCV_core_LIBRARY opencv_core)
      set_property(TARGET opencv_${module} PROPERTY INTERFACE_LINK_LIBRARIES "${OpenCV_core_LIBRARY}")
    endif()
  endif()
  list(APPEND OpenCV_LIBS opencv_${module})
endforeach()
