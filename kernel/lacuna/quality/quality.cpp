// SPDX-License-Identifier: MIT
#include <lacuna/quality/quality.h>
