// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/stroke_font.h>

#include <algorithm>
#include <array>

namespace lacuna::view {

namespace {

constexpr double kCapital = 6; // height of a capital in units of the table
constexpr double kGap = 1.7;   // space between letters, and width of a blank, in units of the table

/// Letters from ' ' to '~'. A stroke is a sequence of digit pairs, x to the right and y down: capitals extend
/// from 0 to 6, small letters from 2 to 6, descenders to 8.
constexpr std::array<std::string_view, 95> kLetters{
    "",                                 // space
    "0004 0606",                        // !
    "0002 2022",                        // "
    "1016 3036 0242 0444",              // #
    "413010010213334445361605 2026",    // $
    "4006 0010110100 3545463635",       // %
    "460201102031320405162644",         // &
    "0002",                             // '
    "10010516",                         // (
    "00111506",                         // )
    "2125 0244 4204",                   // *
    "2125 0343",                        // +
    "1607",                             // ,
    "0333",                             // -
    "0606",                             // .
    "3006",                             // /
    "102031352616050110",               // 0
    "011016 0626",                      // 1
    "01102031320636",                   // 2
    "0110203132233435261605 1323",      // 3
    "36300444",                         // 4
    "30000212233335261605",             // 5
    "312010010516263534231304",         // 6
    "003016",                           // 7
    "13020110203132231304051626353423", // 8
    "051626353120100102132332",         // 9
    "0202 0606",                        // :
    "1212 1607",                        // ;
    "310335",                           // <
    "0242 0444",                        // =
    "013305",                           // >
    "01103041422324 2626",              // ?
    "34141232344441301001051646",       // @
    "062046 1434",                      // A
    "0030414233030006 3344453606",      // B
    "4130100105163645",                 // C
    "00204244260600",                   // D
    "40000646 0333",                    // E
    "400006 0333",                      // F
    "41301001051636454323",             // G
    "0006 4046 0343",                   // H
    "0020 1016 0626",                   // I
    "3035261605",                       // J
    "0006 4004 1346",                   // K
    "000646",                           // L
    "0600234046",                       // M
    "06004640",                         // N
    "103041453616050110",               // O
    "06003041423303",                   // P
    "103041453616050110 2446",          // Q
    "06003041423303 2346",              // R
    "413010010213334445361605",         // S
    "0040 2026",                        // T
    "000516364540",                     // U
    "002640",                           // V
    "0016233640",                       // W
    "0046 4006",                        // X
    "002340 2326",                      // Y
    "00400646",                         // Z
    "10000616",                         // [
    "0036",                             // backslash
    "00101606",                         // ]
    "022042",                           // ^
    "0747",                             // _
    "0011",                             // `
    "0222333616051434",                 // a
    "00062635332202",                   // b
    "321203051636",                     // c
    "30361605031232",                   // d
    "043433221203051636",               // e
    "201116 0222",                      // f
    "32372808 361605031232",            // g
    "0006 02223336",                    // h
    "0206 0000",                        // i
    "121708 1010",                      // j
    "0006 3205 1436",                   // k
    "000516",                           // l
    "0602 02122326 23324346",           // m
    "0602 02223336",                    // n
    "122233352616050312",               // o
    "08022233352606",                   // p
    "38321203051636",                   // q
    "0602 031222",                      // r
    "321203352606",                     // s
    "101526 0222",                      // t
    "02051636 3236",                    // u
    "022642",                           // v
    "0216233642",                       // w
    "0236 3206",                        // x
    "0226 42261808",                    // y
    "02320636",                         // z
    "20111203141526",                   // {
    "0007",                             // |
    "00111223141506",                   // }
    "04133443",                         // ~
};
constexpr std::string_view kUnknown = "0030360600";

} // namespace

StrokedText stroked(std::string_view text)
{
    StrokedText out;
    double left = 0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80 && byte < 0xc0) continue; // a continuation byte of UTF-8
        const std::string_view letter = byte >= ' ' && byte <= '~' ? kLetters[byte - std::size_t{' '}]
                                                                   : kUnknown;
        double width = letter.empty() ? kGap : 0;
        const auto at = [&](std::size_t i) -> Vec2 {
            width = std::max(width, double(letter[i] - '0'));
            return Vec2(left + (letter[i] - '0'), letter[i + 1] - '0') / kCapital;
        };
        for (std::size_t i = 0; i < letter.size();) {
            for (; i + 3 < letter.size() && letter[i + 2] != ' '; i += 2)
                out.strokes.emplace_back(at(i), at(i + 2));
            i += 3; // skip the last pair and a space
        }
        left += width;
        out.width = left / kCapital;
        left += kGap;
    }
    return out;
}

} // namespace lacuna::view
