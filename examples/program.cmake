# What the applications' programs are made of, once for all that are built together: the runtime, and what robots need beside it.
# An application's CMakeLists.txt includes it, so that its program is also a project of its own, which the studio builds and runs.
include_guard(GLOBAL)

set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CXX_FLAGS)
  set(CMAKE_CXX_FLAGS -O2)
endif()
set(cpp ${CMAKE_CURRENT_LIST_DIR}/../cpp)
add_subdirectory(${cpp} ${CMAKE_BINARY_DIR}/runtime)
add_subdirectory(${cpp}/adapters/simulated ${CMAKE_BINARY_DIR}/adapters/simulated)
add_subdirectory(${cpp}/robotics ${CMAKE_BINARY_DIR}/robotics)

# What all programs include is compiled once, and not by each of their files: parsing Eigen takes longer than all else.
add_library(robot-headers STATIC ${CMAKE_CURRENT_LIST_DIR}/headers.cpp)
target_link_libraries(robot-headers PUBLIC groundstate::runtime groundstate::servo groundstate::kinematics groundstate::plant
  groundstate::vision groundstate::simulated groundstate::closed_loop)
target_precompile_headers(robot-headers PRIVATE <functional> <memory> <optional> <string> <vector> <Eigen/Geometry>
  <groundstate/program.hpp> <groundstate/closed_loop/run.hpp> <groundstate/frame_source.hpp>)

# robot_program(NAME): its library NAME-parts of the sources given and of its components' machines, program NAME of main.cpp;
# and beside others a test of tests/closed_loop_test.cpp. The machines are there after `generated.sh`, or `groundstate generate cpp`.
function(robot_program name)
  file(GLOB machines CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/generated/machines/*.cpp)
  add_library(${name}-parts STATIC ${ARGN} ${machines})
  target_include_directories(${name}-parts PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${name}-parts PUBLIC groundstate::runtime groundstate::servo groundstate::kinematics
    groundstate::plant groundstate::vision groundstate::simulated groundstate::closed_loop)
  add_executable(${name} main.cpp)
  target_link_libraries(${name} PRIVATE ${name}-parts)
  set(targets ${name}-parts ${name})
  if(NOT PROJECT_IS_TOP_LEVEL)
    find_package(GTest REQUIRED)
    add_executable(${name}_tests tests/closed_loop_test.cpp)
    target_link_libraries(${name}_tests PRIVATE ${name}-parts GTest::gtest_main)
    add_test(NAME ${name} COMMAND ${name}_tests)
    list(APPEND targets ${name}_tests)
  endif()
  foreach(target ${targets})
    target_precompile_headers(${target} REUSE_FROM robot-headers)
  endforeach()
endfunction()
