# What find_package(first_contact) reads: the libraries that ours depend on, then ours.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 NO_MODULE)
find_dependency(yaml-cpp)
find_dependency(fmt)
find_dependency(CLI11)
find_dependency(nlohmann_json)
find_dependency(Qhull)
find_dependency(Threads)
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)  # a program without first_contact::live needs no cpp-httplib
  pkg_check_modules(HTTPLIB QUIET IMPORTED_TARGET cpp-httplib)
endif()
if(NOT TARGET yaml-cpp::yaml-cpp)  # the name before yaml-cpp 0.8
  add_library(yaml-cpp::yaml-cpp INTERFACE IMPORTED)
  set_target_properties(yaml-cpp::yaml-cpp PROPERTIES INTERFACE_LINK_LIBRARIES yaml-cpp)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/first_contact.cmake)
