/* SPDX-License-Identifier: MIT */
/* A pre-processor in C: options, values in, progress, a mesh as arrays, an error. */
#include <lacuna.h>

#include <stdio.h>
#include <string.h>

static const char recipe[] = "local lacuna = require 'lacuna'\n"
                             "local part = lacuna.synthetic.prism { sides = sides, drop = { 'wall_1' } }\n"
                             "mesh = part:open_volume { source = 'source', target = 'target', walls = 'auto' }\n"
                             "  :sweep { layers = 6, size = 0.3 }\n"
                             "print(mesh)\n"
                             "nodes, cells = mesh:coordinates(), mesh:cells()\n";

/* A pyramid over forty sides, which neither a sweep nor pieces fill. */
static const char pyramid[] =
    "local pyramid = require('lacuna').model()\n"
    "local base, cells = {}, {}\n"
    "for k = 1, 40 do base[k] = { math.cos(2 * math.pi * k / 40), math.sin(2 * math.pi * k / 40), 0 } end\n"
    "for k = 1, 40 do\n"
    "  pyramid:add_face { points = { base[k], base[k % 40 + 1], { 0, 0, 1 } }, cells = { { 1, 2, 3 } } }\n"
    "end\n"
    "for k = 2, 39 do cells[k - 1] = { 1, k + 1, k } end\n"
    "pyramid:add_face { points = base, cells = cells }\n"
    "mesh = pyramid:open_volume {}:sweep { size = 0.2, fallback = 'mixed' }\n"
    "tets = mesh:cells 'tet'\n";

static void print(void* user, const char* text, size_t length)
{
    ++*(int*)user;
    fwrite(text, 1, length, stdout);
}

static int progress(void* user, const char* stage, double share)
{
    (void)user;
    fprintf(stderr, "%s %.0f %%\n", stage, 100 * share);
    return 0; /* go on */
}

int main(void)
{
    int lines = 0;
    lacuna_options options;
    lacuna_default_options(&options);
    options.user = &lines;
    options.print = print;
    options.progress = progress;
    lacuna_interpreter* recipes = lacuna_open(&options);
    if (!recipes) return 1;

    lacuna_set_integer(recipes, "sides", 5);
    if (lacuna_run_string(recipes, recipe, strlen(recipe), "recipe") != LACUNA_OK) {
        fprintf(stderr, "%s\n", lacuna_error_text(recipes));
        return 1;
    }
    lacuna_buffer nodes, cells;
    if (lacuna_get_buffer(recipes, "nodes", &nodes) != LACUNA_OK) return 1;
    if (lacuna_get_buffer(recipes, "cells", &cells) != LACUNA_OK) return 1;
    const double* at = nodes.data;
    const int32_t* first = cells.data; /* numbers of nodes count from 1 */
    printf("lacuna %s: %zu nodes, %zu cells; the first corner is at %g %g %g\n", lacuna_version(), nodes.rows,
           cells.rows, at[3 * (first[0] - 1)], at[3 * (first[0] - 1) + 1], at[3 * (first[0] - 1) + 2]);

    lacuna_buffer tets = {0};
    if (lacuna_run_string(recipes, pyramid, strlen(pyramid), "pyramid") == LACUNA_OK)
        lacuna_get_buffer(recipes, "tets", &tets);
    else if (strcmp(lacuna_error_code(recipes), "cad.no_worker") != 0) /* lacuna-cad makes them */
        return 1;
    printf("%zu tetrahedra in C\n", tets.rows);

    const char wrong[] = "mesh:write 'nowhere/at/all/x.msh'";
    const lacuna_status status = lacuna_run_string(recipes, wrong, strlen(wrong), "recipe");
    printf("%s: %s\n", lacuna_error_code(recipes), lacuna_error_message(recipes));
    const int right = status == LACUNA_FAILED && lines == 1 && cells.columns == 8 && nodes.rows > 0;
    lacuna_close(recipes);
    /* Without an interpreter nothing runs, and what is asked of it says so. */
    if (!*lacuna_error_text(NULL) || !*lacuna_error_message(NULL) || !*lacuna_error_code(NULL)) return 1;
    if (*lacuna_error_file(NULL) || lacuna_error_line(NULL) || *lacuna_error_traceback(NULL)) return 1;
    if (lacuna_error_entity_count(NULL) || lacuna_error_entity(NULL, 0, NULL)) return 1;
    return right ? 0 : 1;
}
