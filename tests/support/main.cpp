// SPDX-License-Identifier: MIT
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdlib>

int main(int argc, char** argv)
{
#ifdef LACUNA_CAD_PROGRAM
    ::setenv("LACUNA_CAD", LACUNA_CAD_PROGRAM, 0); // the tests lie in other folders of the build than it
#endif
    return doctest::Context(argc, argv).run();
}
