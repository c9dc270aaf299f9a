# What Debian wants of each package beside what `cmake --install` puts there, done in CPack's staging folders.
set(top "${CMAKE_CURRENT_LIST_DIR}/../..")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(changes "reedvalve (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * Packed by CPack; what is new stands in the project's own changelog.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(share "${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/share")
  set(doc "${share}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME}")
  file(WRITE "${doc}/changelog.Debian" "${changes}")
  file(READ "${top}/CHANGELOG.md" news)
  file(WRITE "${doc}/changelog" "${news}")
  file(READ "${top}/LICENSE" licence)
  file(WRITE "${doc}/copyright" "${licence}")
  file(GLOB pages "${doc}/changelog*" "${share}/man/man1/*.1")
  execute_process(COMMAND gzip -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)
endforeach()

# Their places in Debian: zsh's completion, the licence and the changelog
set(share "${CPACK_TEMPORARY_DIRECTORY}/program/usr/share")
file(MAKE_DIRECTORY "${share}/zsh/vendor-completions")
file(RENAME "${share}/zsh/site-functions/_reedvalve" "${share}/zsh/vendor-completions/_reedvalve")
file(REMOVE_RECURSE "${share}/zsh/site-functions" "${share}/doc/reedvalve/LICENSE" "${share}/doc/reedvalve/CHANGELOG.md")
