# Sets leftByRuns: arguments of install(DIRECTORY tutorials ...) that leave out what .gitignore names of the
# tutorials, results of runs in the source tree. A package would have them otherwise, and a copied tutorial would go
# on from them.
set(gitignore ${PROJECT_SOURCE_DIR}/.gitignore)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${gitignore})
file(STRINGS ${gitignore} patterns REGEX "^/tutorials/")
string(REGEX REPLACE "([][+.*()^$?|\\])" "\\\\\\1" sourceFolder "${PROJECT_SOURCE_DIR}")
set(leftByRuns PATTERN __pycache__ EXCLUDE)
foreach(pattern IN LISTS patterns)
    # `**/` is any number of folders, `*` anything within a name, `[1-9]` as in regular expressions; names of folders
    # end in /.
    string(REGEX REPLACE "/$" "" pattern "${pattern}")
    string(REPLACE "." "\\." pattern "${pattern}")
    string(REPLACE "**/" "<folders>" pattern "${pattern}")
    string(REPLACE "*" "[^/]*" pattern "${pattern}")
    string(REPLACE "<folders>" "(.*/)?" pattern "${pattern}")
    list(APPEND leftByRuns REGEX "^${sourceFolder}${pattern}$" EXCLUDE)
endforeach()
