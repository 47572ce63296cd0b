# SPDX-License-Identifier: BSD-3-Clause
# Puts the case files that `abradem new` writes into the program, so that it needs no files beside it.
set(ABRADEM_CASE_TEMPLATES
    pin-on-disc ${PROJECT_SOURCE_DIR}/cases/pin-on-disc.toml
    plate ${PROJECT_SOURCE_DIR}/cases/templates/plate.toml
    laboratory ${PROJECT_SOURCE_DIR}/cases/laboratory.toml
    chute ${PROJECT_SOURCE_DIR}/cases/templates/chute.toml
    hopper ${PROJECT_SOURCE_DIR}/cases/hopper.toml
    angle-of-repose ${PROJECT_SOURCE_DIR}/cases/angle-of-repose.toml)

set(ABRADEM_TEMPLATE_ENTRIES "")
while(ABRADEM_CASE_TEMPLATES)
  list(POP_FRONT ABRADEM_CASE_TEMPLATES template_name template_file)
  file(READ ${template_file} template_text)
  string(APPEND ABRADEM_TEMPLATE_ENTRIES "    {\"${template_name}\", R\"case(${template_text})case\"},\n")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${template_file})
endwhile()
configure_file(${PROJECT_SOURCE_DIR}/cmake/templates.cpp.in ${PROJECT_BINARY_DIR}/generated/templates.cpp @ONLY)
