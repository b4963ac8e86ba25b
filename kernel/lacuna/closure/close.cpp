// SPDX-License-Identifier: MIT
#include <lacuna/closure/close.h>
