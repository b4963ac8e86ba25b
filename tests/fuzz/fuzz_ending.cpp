// SPDX-License-Identifier: MIT
extern "C" const char* const kFuzzEnding = LACUNA_FUZZ_ENDING;
