# The archive of Plotly is used where its hash is the one that is pinned, and for nothing else: what npm delivers, what
# lies there already, and a machine without npm.
# Usage: cmake -DROOT=project -DFOLDER=scratch -P plotly_hash.cmake
cmake_minimum_required(VERSION 3.25)
if(DEFINED ARCHIVE) # as a build would: ARCHIVE is what npm delivers, or nothing
  include(${ROOT}/src/report/plotly.cmake)
  if(DEFINED PINNED)
    set(WHIRL_PLOTLY_SHA512 ${PINNED})
  endif()
  set(NPM ${FOLDER}/npm)
  if(NOT ARCHIVE STREQUAL "")
    file(WRITE ${NPM} "#!/bin/sh\ncp '${ARCHIVE}' \"$3/plotly.js-basic-dist-min-2.35.3.tgz\"\n")
  else()
    file(WRITE ${NPM} "#!/bin/sh\nexit 1\n")
  endif()
  file(CHMOD ${NPM} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  whirl_plotly(${FOLDER}/npm_files script)
  message("script: ${script}")
  return()
endif()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER}/made/package)
file(WRITE ${FOLDER}/made/package/plotly-basic.min.js "drawn")
set(archive ${FOLDER}/made/any.tgz)
execute_process(COMMAND ${CMAKE_COMMAND} -E tar czf ${archive} package WORKING_DIRECTORY ${FOLDER}/made
  COMMAND_ERROR_IS_FATAL ANY)
file(SHA512 ${archive} its_hash)

# build(NAME ARCHIVE OPTION...): status and words of such a build, in a folder of its own unless it has one.
macro(build name archive)
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${ROOT} -DFOLDER=${FOLDER}/${name} "-DARCHIVE=${archive}" ${ARGN}
    -P ${CMAKE_CURRENT_LIST_FILE} RESULT_VARIABLE status OUTPUT_VARIABLE words ERROR_VARIABLE words)
endmacro()
set(extracted npm_files/package/plotly-basic.min.js)
set(kept npm_files/plotly.js-basic-dist-min-2.35.3.tgz)

build(good ${archive} -DPINNED=${its_hash})
if(NOT status EQUAL 0 OR NOT EXISTS ${FOLDER}/good/${extracted})
  message(SEND_ERROR "the right archive is not used: ${words}")
endif()
build(good "" -DPINNED=${its_hash}) # offline, and it is there
if(NOT status EQUAL 0 OR NOT words MATCHES "script: .*plotly-basic.min.js")
  message(SEND_ERROR "the archive that is there is not used: ${words}")
endif()
build(bad ${archive}) # the hash is Plotly's
if(status EQUAL 0 OR NOT words MATCHES "SHA-512" OR EXISTS ${FOLDER}/bad/${extracted} OR EXISTS ${FOLDER}/bad/${kept})
  message(SEND_ERROR "an archive of another content is used, or kept: ${words}")
endif()
file(MAKE_DIRECTORY ${FOLDER}/changed/npm_files)
file(WRITE ${FOLDER}/changed/${kept} "changed later")
build(changed "")
if(status EQUAL 0 OR NOT words MATCHES "SHA-512")
  message(SEND_ERROR "an archive that was changed later is used: ${words}")
endif()
build(none "")
if(NOT status EQUAL 0 OR NOT words MATCHES "script: \n")
  message(SEND_ERROR "without npm the build does not go on: ${words}")
endif()
