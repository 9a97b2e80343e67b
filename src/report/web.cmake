# The files of web/, which the pages are made of, as one source.
set(folder ${CMAKE_CURRENT_LIST_DIR})
file(GLOB web_files CONFIGURE_DEPENDS ${folder}/web/*.js ${folder}/web/*.css ${folder}/web/*.html)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${web_files})
set(entries "")
foreach(web_file ${web_files})
  get_filename_component(name ${web_file} NAME)
  file(READ ${web_file} text)
  string(APPEND entries "        {\"${name}\", R\"web(${text})web\"},\n")
endforeach()
set(embedded ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp)
file(CONFIGURE OUTPUT ${embedded} @ONLY CONTENT [[
#include "report/common/html.h"

#include <map>

namespace whirl::report {

std::string embedded(const std::string &name) {
    static const std::map<std::string, const char *> files{
@entries@    };
    const auto found = files.find(name);
    return found == files.end() ? "" : found->second;
}

} // namespace whirl::report
]])
target_sources(whirl_report PRIVATE ${embedded})

# Without it the build goes on and the reports show still pictures.
include(${folder}/plotly.cmake)
whirl_plotly(${PROJECT_BINARY_DIR}/npm plotly_file)
if(plotly_file)
  set_source_files_properties(${folder}/common/plotly.cpp
    PROPERTIES COMPILE_DEFINITIONS WHIRL_PLOTLY_FILE="${plotly_file}" OBJECT_DEPENDS ${plotly_file})
else()
  message(STATUS "Plotly not found: HTML reports will show still pictures")
endif()
