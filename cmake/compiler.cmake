# SPDX-License-Identifier: BSD-3-Clause
# One interface target carries what every translation unit is compiled with.
add_library(abradem_options INTERFACE)
target_compile_features(abradem_options INTERFACE cxx_std_20)
# Same bits on every machine: no fused multiply-add behind our back, never -ffast-math.
target_compile_options(abradem_options INTERFACE -ffp-contract=off)
# Nobody reads errno or floating-point traps here; without these two, loops with sqrt cannot be vectorised.
# Neither changes a result.
target_compile_options(abradem_options INTERFACE -fno-math-errno -fno-trapping-math)
target_compile_options(abradem_options INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wno-sign-conversion>)
if(ABRADEM_WERROR)
  target_compile_options(abradem_options INTERFACE -Werror)
endif()
if(ABRADEM_SANITIZE)
  target_compile_options(abradem_options INTERFACE -fsanitize=${ABRADEM_SANITIZE} -fno-sanitize-recover=all
                         -fno-omit-frame-pointer)
  target_link_options(abradem_options INTERFACE -fsanitize=${ABRADEM_SANITIZE})
  # Function multiversioning resolves through ifunc before the sanitizers are ready.
  target_compile_definitions(abradem_options INTERFACE ABRADEM_NO_DISPATCH)
endif()
if(ABRADEM_BUILD_FUZZ)  # coverage for libFuzzer in everything; its main() only in the fuzzers
  target_compile_options(abradem_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
find_program(ABRADEM_CCACHE ccache)
if(ABRADEM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ABRADEM_CCACHE})
endif()
