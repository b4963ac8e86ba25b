// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/number_text.h>

#include <doctest/doctest.h>

#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

using namespace lacuna;

TEST_CASE("numbers in messages are what printf writes in the C locale")
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-300, 300), mantissa(-1, 1);
    for (int k = 0; k < 2000; ++k) {
        const double value = k < 3 ? k - 1.0 : mantissa(random) * std::pow(10.0, exponent(random));
        for (const int digits : {2, 4, 6}) {
            char text[64];
            std::snprintf(text, sizeof text, "%.*g", digits, value);
            CHECK(with_digits(value, digits) == text);
            char fixed[400];
            std::snprintf(fixed, sizeof fixed, "%.*f", digits, value);
            CHECK(with_decimals(value, digits) == fixed);
        }
    }
    CHECK(place_with_digits({0.5, 1.25, -3}, 4) == "(0.5, 1.25, -3)");
}

TEST_CASE("the host's locale changes no number in a message")
{
    const std::string before = std::setlocale(LC_ALL, nullptr);
    const char* comma = nullptr;
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"})
        if (comma == nullptr && std::setlocale(LC_ALL, name) != nullptr) comma = name;
    if (comma == nullptr) MESSAGE("no locale with a decimal comma is installed");
    CHECK(with_digits(0.034, 2) == "0.034");
    CHECK(with_decimals(-1, 2) == "-1.00");
    std::setlocale(LC_ALL, before.c_str());
}
