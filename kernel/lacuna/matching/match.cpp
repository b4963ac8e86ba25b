// SPDX-License-Identifier: MIT
#include <lacuna/matching/match.h>
