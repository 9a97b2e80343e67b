# Plotly for the HTML reports, from its npm package (MIT licence): a version, and the hash of its archive, which is
# the registry's dist.integrity in hexadecimal.
set(WHIRL_PLOTLY_PACKAGE plotly.js-basic-dist-min)
set(WHIRL_PLOTLY_VERSION 2.35.3)
set(WHIRL_PLOTLY_SHA512
  662a409b2304d12e6a59e73a183cb67713fe13a4218b45fa78dc07ea0cbb9b960c2984a0ac362b73eff73d33d6a49b31708305d24aa83abb97f92807d95c0e5a)

# whirl_plotly(folder file): the script in the archive that npm packs into the folder, or that lies there already; its
# path, or nothing without npm or network. An archive of another content is an error, and is used for nothing.
function(whirl_plotly folder file)
  set(${file} "" PARENT_SCOPE)
  set(archive ${folder}/${WHIRL_PLOTLY_PACKAGE}-${WHIRL_PLOTLY_VERSION}.tgz)
  if(NOT EXISTS ${archive})
    find_program(NPM npm)
    if(NPM)
      file(MAKE_DIRECTORY ${folder})
      execute_process(
        COMMAND ${NPM} pack --pack-destination ${folder} ${WHIRL_PLOTLY_PACKAGE}@${WHIRL_PLOTLY_VERSION}
        WORKING_DIRECTORY ${folder} TIMEOUT 120 OUTPUT_QUIET ERROR_QUIET)
    endif()
  endif()
  if(NOT EXISTS ${archive})
    return()
  endif()
  file(SHA512 ${archive} hash)
  if(NOT hash STREQUAL WHIRL_PLOTLY_SHA512)
    file(REMOVE ${archive})
    message(FATAL_ERROR "${archive} was not ${WHIRL_PLOTLY_PACKAGE} ${WHIRL_PLOTLY_VERSION}: its SHA-512 was ${hash}. "
      "It has been removed; without npm the reports show still pictures.")
  endif()
  file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${folder} PATTERNS package/plotly-basic.min.js)
  set(${file} ${folder}/package/plotly-basic.min.js PARENT_SCOPE)
endfunction()
