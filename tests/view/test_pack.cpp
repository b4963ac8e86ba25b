// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/base64.h>
#include <lacuna/view/detail/deflate.h>
#include <lacuna/view/detail/json.h>

#include <doctest/doctest.h>

#include <limits>

using namespace lacuna;

TEST_CASE("base 64 and CRC-32 are those of the standards' samples")
{
    // RFC 4648, section 10.
    const char* const plain[] = {"", "f", "fo", "foo", "foob", "fooba", "foobar"};
    const char* const coded[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    for (std::size_t i = 0; i < std::size(plain); ++i) CHECK(view::base64(plain[i]) == coded[i]);
    CHECK(view::crc32("123456789") == 0xcbf43926U);
}

TEST_CASE("what follows a line is packed into next to nothing")
{
    std::vector<Index> numbers;
    for (Index i = 0; i < 90'000; ++i) numbers.push_back(i / 3 * 7 + i % 3 * 1000);
    CHECK(view::pack(numbers, 3, true).size() < numbers.size() / 50);
}

TEST_CASE("a text in the data can neither end its element nor its quotes, whatever it holds")
{
    view::Json json;
    json.begin_object().member("</script>", "</script><script>\"'\\&\n\x01 é").end_object();
    for (const char c : {'<', '>', '&', '\'', '\n', '\x01'}) {
        const bool held = json.text().find(c) != std::string::npos;
        CHECK(held == (c == '\''));
    }
    CHECK(json.text() ==
          "{\"\\u003c/script\\u003e\":\"\\u003c/script\\u003e\\u003cscript\\u003e\\u0022'\\u005c"
          "\\u0026\\u000a\\u0001 é\"}");
}

TEST_CASE("what is no number is null, and numbers have a point in any locale")
{
    view::Json json;
    json.begin_array().value(0.5).value(std::numeric_limits<double>::infinity()).value(3).value(true);
    json.value(Vec3(1, -2.25, 1e-9)).end_array();
    CHECK(json.text() == "[0.5,null,3,true,[1,-2.25,1e-09]]");
}
