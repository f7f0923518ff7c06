# What Debian's policy wants of a package beyond what `cmake --install` makes (12.1 and 12.7): manual pages and a
# changelog, both compressed and without dates of now. Run by cpack with the files of both packages in
# CPACK_TEMPORARY_DIRECTORY.
file(GLOB pages ${CPACK_TEMPORARY_DIRECTORY}/applications/usr/share/man/man1/*.1)
set(date $ENV{SOURCE_DATE_EPOCH})
if(NOT date)
    execute_process(COMMAND git -C ${CMAKE_CURRENT_LIST_DIR} log -1 --format=%ct OUTPUT_VARIABLE date
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
execute_process(COMMAND date -u -R -d @${date} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT date)
    execute_process(COMMAND date -u -R OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE) # a source without git
endif()
foreach(component applications python)
    set(name drystone)
    if(component STREQUAL "python")
        set(name python3-drystone)
    endif()
    set(changelog ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/share/doc/${name}/changelog)
    if(EXISTS ${CPACK_TEMPORARY_DIRECTORY}/${component})
        file(WRITE ${changelog} "drystone (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n"
            "  * What has changed is in CHANGELOG.md.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
        list(APPEND pages ${changelog})
    endif()
endforeach()
execute_process(COMMAND gzip -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)
