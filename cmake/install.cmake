# What `cmake --install` and the Debian package hold: applications, manual pages, completion, tutorials, and the files
# of etc/ that cases use; the former the libraries too. Paths are relative, so that the prefix can be chosen when
# installing.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME applications)

get_property(drystone_applications GLOBAL PROPERTY DRYSTONE_APPLICATIONS)
set(share ${CMAKE_INSTALL_DATADIR}/drystone)
install(TARGETS ${drystone_applications} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# As git has them: without what a run in the source tree left.
include(${CMAKE_CURRENT_LIST_DIR}/leftByRuns.cmake)
install(DIRECTORY tutorials DESTINATION ${share} USE_SOURCE_PERMISSIONS ${leftByRuns})
install(DIRECTORY etc/annotated etc/cases etc/paraview etc/tools DESTINATION ${share}/etc USE_SOURCE_PERMISSIONS)
install(FILES README.md GUIDE.md CHANGELOG.md CONTRIBUTING.md LICENSE CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
# Where Debian's Python looks for packages when the prefix is /usr; with another, RunFunctions adds it to PYTHONPATH.
install(DIRECTORY python/drystone DESTINATION lib/python3/dist-packages COMPONENT python PATTERN "__pycache__" EXCLUDE)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-drystone COMPONENT python)
# Each package has one (Debian policy, 12.5).
install(FILES etc/debian/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/drystone)
install(FILES etc/debian/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-drystone COMPONENT python)
install(FILES etc/bash_completion DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME blockTexture)

# The libraries, for programs of others: find_package(Drystone), Drystone::statics (test/installation/consumer).
include(CMakePackageConfigHelpers)
get_property(drystone_libraries GLOBAL PROPERTY DRYSTONE_LIBRARIES)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Drystone)
install(TARGETS ${drystone_libraries} EXPORT DrystoneTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(DIRECTORY libs/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/drystone COMPONENT development
    FILES_MATCHING PATTERN "*.h" PATTERN viewer EXCLUDE)
install(EXPORT DrystoneTargets NAMESPACE Drystone:: DESTINATION ${package} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/DrystoneConfig.cmake.in ${CMAKE_BINARY_DIR}/DrystoneConfig.cmake
    INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/DrystoneConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/DrystoneConfig.cmake ${CMAKE_BINARY_DIR}/DrystoneConfigVersion.cmake
    DESTINATION ${package} COMPONENT development)

# A tutorial that was copied elsewhere finds RunFunctions next to the applications: in bin/ of the build and of the
# installation. drystone-new is a script that stands there in the same way. bash-completion looks for a file by the name
# of the command. Runs copy etc/paraview/drystone.py into the folder of their series.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/etc/tools/RunFunctions ${CMAKE_BINARY_DIR}/bin/drystoneRunFunctions SYMBOLIC)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/etc/tools/drystone-new ${CMAKE_BINARY_DIR}/bin/drystone-new SYMBOLIC)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share/drystone)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/etc ${CMAKE_BINARY_DIR}/share/drystone/etc SYMBOLIC)
file(RELATIVE_PATH docToShare "/${CMAKE_INSTALL_DOCDIR}" "/${share}")
install(CODE "
    set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
    file(CREATE_LINK ../${share}/etc/tools/RunFunctions \"\${prefix}/${CMAKE_INSTALL_BINDIR}/drystoneRunFunctions\" SYMBOLIC)
    file(CREATE_LINK ../${share}/etc/tools/drystone-new \"\${prefix}/${CMAKE_INSTALL_BINDIR}/drystone-new\" SYMBOLIC)
    # README and GUIDE lead to folders of the source tree.
    foreach(folder tutorials etc)
        file(CREATE_LINK \"${docToShare}/\${folder}\" \"\${prefix}/${CMAKE_INSTALL_DOCDIR}/\${folder}\" SYMBOLIC)
    endforeach()
    file(MAKE_DIRECTORY \"\${prefix}/${CMAKE_INSTALL_MANDIR}/man1\")
    foreach(application ${drystone_applications} drystone-new)
        if(NOT application STREQUAL blockTexture)
            file(CREATE_LINK blockTexture
                \"\${prefix}/${CMAKE_INSTALL_DATADIR}/bash-completion/completions/\${application}\" SYMBOLIC)
        endif()
        execute_process(
            COMMAND bash \"${PROJECT_SOURCE_DIR}/etc/tools/manualPage\" \"\${prefix}/${CMAKE_INSTALL_BINDIR}/\${application}\"
            OUTPUT_FILE \"\${prefix}/${CMAKE_INSTALL_MANDIR}/man1/\${application}.1\" COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
")

# cpack -G DEB, in the build folder: drystone_*.deb and python3-drystone_*.deb. The shared libraries that the first
# depends on are found by dpkg-shlibdeps, but for cairo, which is loaded by name (libs/io); the second is pure Python.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME drystone)
set(CPACK_PACKAGE_CONTACT "the Drystone authors <drystone@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "limit analysis and dynamics of structures of rigid blocks with dry joints")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL applications python)
set(CPACK_DEBIAN_APPLICATIONS_PACKAGE_NAME drystone)
set(CPACK_DEBIAN_APPLICATIONS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_APPLICATIONS_PACKAGE_DEPENDS libcairo2)
set(CPACK_COMPONENT_APPLICATIONS_DESCRIPTION
    "Masonry walls, arches, vaults, houses and columns of stone: block textures
and imported blocks, limit analysis by cone programming with certificates,
dynamics with friction and impacts, incremental dynamics and ensembles. Used
through case directories with dictionaries, in the manner of OpenFOAM;
results open in ParaView.")
set(CPACK_DEBIAN_APPLICATIONS_PACKAGE_SUGGESTS "python3-drystone, bash-completion")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-drystone)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.9)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "drystone, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-matplotlib")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python package that runs Drystone and reads its results")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debianFiles.cmake)
include(CPack)
