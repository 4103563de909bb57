# fpi::options: what every target of ours is compiled with.
add_library(fpi_options INTERFACE)
add_library(fpi::options ALIAS fpi_options)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(fpi_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    -Woverloaded-virtual
    # g++ 12 reports these falsely inside fmt's and Eigen's inlined headers.
    -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds -Wno-maybe-uninitialized -Wno-uninitialized)
endif()
if(CMAKE_UNITY_BUILD)
  target_compile_options(fpi_options INTERFACE -Wno-shadow)  # names of one source that another has are no fault
endif()
if(FPI_MARCH)
  target_compile_options(fpi_options INTERFACE -march=${FPI_MARCH})
endif()
if(NOT FPI_MARCH MATCHES "native|v3|v4")
  # Without AVX four lanes (core/lanes.hpp) are passed in memory. All that passes them is compiled here.
  target_compile_options(fpi_options INTERFACE -Wno-psabi)
endif()
if(FPI_SANITIZE)
  target_compile_options(fpi_options INTERFACE -fsanitize=${FPI_SANITIZE} -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  target_link_options(fpi_options INTERFACE -fsanitize=${FPI_SANITIZE})
endif()
