# Tests without meaning in a build with sanitizers (preset `asan`), by name and with the reason. ctest omits them in
# such a build; in every other build they are run.
set(leftOutWithSanitizers
    # compare times with those of an optimised build
    dictionary.Dictionary.AMillionNumbersAreReadInASecond
    io.VtkSeries.AFrameOf146BlocksAnd702ContactsTakesNoLongerThanAStepOrTwo
    roundTrips.manyBlocks
)

list(JOIN leftOutWithSanitizers " " leftOutWithSanitizers)
file(APPEND ${CMAKE_BINARY_DIR}/CTestCustom.cmake "set(CTEST_CUSTOM_TESTS_IGNORE ${leftOutWithSanitizers})\n")
