/* Drives the FMU through the C functions of the standard, without any other library: the magnet passes.

   Build and run, with the FMU unpacked to the folder `unpacked`:

       gcc -std=c11 -Wall -Wextra -Ifmu/headers -o drive fmu/examples/c/drive.c -ldl
       ./drive unpacked fmu/examples/magnet_pass.csv driven.csv

   The first line of the inputs names `time` and input variables. For a step to the time of a row the inputs of this row
   are set, then the step is taken: a row of the outputs is the answer to the inputs of the same time. Half-way the state
   is saved; at the end it is restored and the second half is driven again, which must give the same numbers. */

#define _XOPEN_SOURCE 700 /* POSIX, with realpath */
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2FunctionTypes.h"

enum { MOST_INPUTS = 16, MOST_ROWS = 1024, LONGEST_LINE = 4096 };

static const char *const OUTPUTS[] = {
    "tip.angle",          "tip.position[1]",          "tip.position[2]",          "tip.position[3]",
    "force.magnetic[1]",  "force.magnetic[2]",        "force.magnetic[3]",        "magnet.reaction_force[1]",
    "magnet.reaction_force[2]", "magnet.reaction_force[3]",
};
enum { OUTPUT_COUNT = sizeof OUTPUTS / sizeof OUTPUTS[0] };

static _Noreturn void stop(const char *what, const char *which)
{
    fprintf(stderr, "%s: %s\n", what, which);
    exit(1);
}

/* The functions that are used, found in the library by their names. */
static struct {
    fmi2InstantiateTYPE *Instantiate;
    fmi2FreeInstanceTYPE *FreeInstance;
    fmi2SetupExperimentTYPE *SetupExperiment;
    fmi2EnterInitializationModeTYPE *EnterInitializationMode;
    fmi2ExitInitializationModeTYPE *ExitInitializationMode;
    fmi2TerminateTYPE *Terminate;
    fmi2SetRealTYPE *SetReal;
    fmi2GetRealTYPE *GetReal;
    fmi2DoStepTYPE *DoStep;
    fmi2GetFMUstateTYPE *GetFMUstate;
    fmi2SetFMUstateTYPE *SetFMUstate;
    fmi2FreeFMUstateTYPE *FreeFMUstate;
} fmi;

static void *load(const char *folder)
{
    char path[LONGEST_LINE];
    snprintf(path, sizeof path, "%s/binaries/linux64/mcm.so", folder);
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) stop("cannot load", dlerror());
/* C has no conversion from an object's to a function's pointer; POSIX promises that the bytes are the same. */
#define FIND(name)                                                   \
    do {                                                             \
        void *found = dlsym(library, "fmi2" #name);                  \
        if (!found) stop("the library lacks", "fmi2" #name);         \
        memcpy(&fmi.name, &found, sizeof found);                     \
    } while (0)
    FIND(Instantiate);
    FIND(FreeInstance);
    FIND(SetupExperiment);
    FIND(EnterInitializationMode);
    FIND(ExitInitializationMode);
    FIND(Terminate);
    FIND(SetReal);
    FIND(GetReal);
    FIND(DoStep);
    FIND(GetFMUstate);
    FIND(SetFMUstate);
    FIND(FreeFMUstate);
#undef FIND
    return library;
}

/* Whole content of `folder`/modelDescription.xml, to be freed. */
static char *description(const char *folder)
{
    char path[LONGEST_LINE];
    snprintf(path, sizeof path, "%s/modelDescription.xml", folder);
    FILE *file = fopen(path, "rb");
    if (!file) stop("cannot open", path);
    fseek(file, 0, SEEK_END);
    const long size = ftell(file);
    rewind(file);
    char *text = calloc((size_t)size + 1, 1);
    if (!text || fread(text, 1, (size_t)size, file) != (size_t)size) stop("cannot read", path);
    fclose(file);
    return text;
}

/* Value reference of a variable: in our descriptions it stands right behind the name. */
static fmi2ValueReference reference(const char *xml, const char *name)
{
    char sought[LONGEST_LINE];
    snprintf(sought, sizeof sought, "name=\"%s\" valueReference=\"", name);
    const char *found = strstr(xml, sought);
    if (!found) stop("the FMU has no variable", name);
    return (fmi2ValueReference)strtoul(found + strlen(sought), NULL, 10);
}

static void guid(const char *xml, char *out, size_t size)
{
    const char *start = strstr(xml, " guid=\"");
    if (!start) stop("the description has no", "guid");
    snprintf(out, size, "%.*s", (int)strcspn(start + 7, "\""), start + 7);
}

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
    (void)environment;
    va_list arguments;
    va_start(arguments, message);
    fprintf(stderr, "%s [%s, status %d] ", instance, category, (int)status);
    vfprintf(stderr, message, arguments);
    fputc('\n', stderr);
    va_end(arguments);
}

static void check(fmi2Status status, const char *call)
{
    if (status > fmi2Warning) stop("refused", call);
}

/* The inputs over time. */
static struct {
    size_t count, rows;
    fmi2ValueReference references[MOST_INPUTS];
    double time[MOST_ROWS], values[MOST_ROWS][MOST_INPUTS];
} inputs;

static void read_inputs(const char *path, const char *xml)
{
    FILE *file = fopen(path, "r");
    char line[LONGEST_LINE];
    if (!file || !fgets(line, sizeof line, file)) stop("cannot read", path);
    strtok(line, ",\r\n"); /* time */
    for (char *name; (name = strtok(NULL, ",\r\n"));) {
        if (inputs.count == MOST_INPUTS) stop("too many inputs in", path);
        inputs.references[inputs.count++] = reference(xml, name);
    }
    while (fgets(line, sizeof line, file)) {
        if (inputs.rows == MOST_ROWS) stop("too many rows in", path);
        char *next = line;
        inputs.time[inputs.rows] = strtod(next, &next);
        for (size_t k = 0; k < inputs.count; ++k) {
            if (*next != ',') stop("a row is too short in", path);
            inputs.values[inputs.rows][k] = strtod(next + 1, &next);
        }
        ++inputs.rows;
    }
    fclose(file);
    if (inputs.rows < 2) stop("no steps in", path);
}

static void set_inputs(fmi2Component device, size_t row)
{
    check(fmi.SetReal(device, inputs.references, inputs.count, inputs.values[row]), "fmi2SetReal");
}

/* Drives from row `first` to row `last`, the inputs of a step being those of its end; keeps the outputs of every row after
   the first. */
static void drive(fmi2Component device, size_t first, size_t last, const fmi2ValueReference *outputs,
                  double kept[][OUTPUT_COUNT])
{
    for (size_t row = first; row < last; ++row) {
        set_inputs(device, row + 1);
        const double step = inputs.time[row + 1] - inputs.time[row];
        check(fmi.DoStep(device, inputs.time[row], step, fmi2False), "fmi2DoStep");
        check(fmi.GetReal(device, outputs, OUTPUT_COUNT, kept[row + 1]), "fmi2GetReal");
    }
}

static void write_outputs(const char *path, double kept[][OUTPUT_COUNT])
{
    FILE *file = fopen(path, "w");
    if (!file) stop("cannot write", path);
    fputs("time", file);
    for (size_t k = 0; k < OUTPUT_COUNT; ++k) fprintf(file, ",%s", OUTPUTS[k]);
    fputc('\n', file);
    for (size_t row = 0; row < inputs.rows; ++row) {
        fprintf(file, "%.9g", inputs.time[row]);
        for (size_t k = 0; k < OUTPUT_COUNT; ++k) fprintf(file, ",%.17g", kept[row][k]);
        fputc('\n', file);
    }
    if (fclose(file)) stop("cannot write", path);
}

int main(int count, char **arguments)
{
    if (count != 4) stop("usage", "drive UNPACKED_FMU INPUTS.csv OUTPUTS.csv");
    /* The URI of the resources needs the absolute path: in file://unpacked/resources, `unpacked` would be the name of a host. */
    char *folder = realpath(arguments[1], NULL);
    if (!folder) stop("there is no folder", arguments[1]);
    void *library = load(folder);
    char *xml = description(folder);
    read_inputs(arguments[2], xml);
    fmi2ValueReference outputs[OUTPUT_COUNT];
    for (size_t k = 0; k < OUTPUT_COUNT; ++k) outputs[k] = reference(xml, OUTPUTS[k]);
    char id[128], resources[LONGEST_LINE];
    guid(xml, id, sizeof id);
    snprintf(resources, sizeof resources, "file://%s/resources", folder);
    free(xml);
    free(folder);

    const fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};
    fmi2Component device =
        fmi.Instantiate("drive", fmi2CoSimulation, id, resources, &callbacks, fmi2False, fmi2False);
    if (!device) stop("refused", "fmi2Instantiate");
    check(fmi.SetupExperiment(device, fmi2False, 0.0, inputs.time[0], fmi2False, 0.0), "fmi2SetupExperiment");
    check(fmi.EnterInitializationMode(device), "fmi2EnterInitializationMode");
    set_inputs(device, 0);
    check(fmi.ExitInitializationMode(device), "fmi2ExitInitializationMode");

    static double kept[MOST_ROWS][OUTPUT_COUNT], again[MOST_ROWS][OUTPUT_COUNT];
    const size_t last = inputs.rows - 1, middle = last / 2;
    fmi2FMUstate state = NULL;
    check(fmi.GetReal(device, outputs, OUTPUT_COUNT, kept[0]), "fmi2GetReal");
    drive(device, 0, middle, outputs, kept);
    check(fmi.GetFMUstate(device, &state), "fmi2GetFMUstate");
    drive(device, middle, last, outputs, kept);
    write_outputs(arguments[3], kept);
    check(fmi.SetFMUstate(device, state), "fmi2SetFMUstate");
    drive(device, middle, last, outputs, again);
    if (memcmp(kept[middle + 1], again[middle + 1], (last - middle) * sizeof kept[0]))
        stop("the restored state does not repeat", "the second half");

    check(fmi.FreeFMUstate(device, &state), "fmi2FreeFMUstate");
    check(fmi.Terminate(device), "fmi2Terminate");
    fmi.FreeInstance(device);
    dlclose(library);
    return 0;
}
