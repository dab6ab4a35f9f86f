// Executes an emitted file of OpenCL C: FILE POINTS RESULTS COUNT NUMBER. CLFLAGS are further options.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *KERNEL =
    "\nkernel void judge(global const NUMBER *points, global NUMBER *results, global uint *statuses) {\n"
    "    const size_t point = get_global_id(0), count = sizeof(energy_parameters) / sizeof(NUMBER);\n"
    "    energy_parameters p;\n"
    "    NUMBER F[9], psi, P[9], A[81];\n"
    "    points += point * (count + 9), results += point * 190, statuses += point * 4;\n"
    "    for (size_t k = 0; k < count; k++) ((NUMBER *)&p)[k] = points[k];\n"
    "    for (size_t k = 0; k < 9; k++) F[k] = points[count + k];\n"
    "    statuses[0] = energy_check(&p) == 1 ? ~0u : energy_energy(&p, F, &psi), results[0] = psi;\n"
    "    statuses[1] = energy_stress(&p, F, P);\n"
    "    for (size_t k = 0; k < 9; k++) results[1 + k] = P[k];\n"
    "    statuses[2] = energy_tangent(&p, F, P, A);\n"
    "    for (size_t k = 0; k < 9; k++) results[10 + k] = P[k];\n"
    "    for (size_t k = 0; k < 81; k++) results[19 + k] = A[k];\n"
    "    statuses[3] = energy_projected(&p, F, P, A);\n"
    "    for (size_t k = 0; k < 9; k++) results[100 + k] = P[k];\n"
    "    for (size_t k = 0; k < 81; k++) results[109 + k] = A[k];\n"
    "}\n";

static void check(cl_int error, const char *what) {
    if (error != CL_SUCCESS) fprintf(stderr, "%s: error %d of OpenCL\n", what, error), exit(1);
}

static char *read(const char *name, size_t *size) {
    FILE *file = fopen(name, "rb");
    if (!file) perror(name), exit(1);
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    char *bytes = calloc(*size + 1, 1);
    if (fread(bytes, 1, *size, file) != *size) perror(name), exit(1);
    fclose(file);
    return bytes;
}

int main(int count, char **arguments) {
    if (count != 6) return 1;
    size_t length, size;
    const char *text = read(arguments[1], &length);
    char *points = read(arguments[2], &size);
    const size_t all = strtoul(arguments[4], NULL, 10), width = strcmp(arguments[5], "float") ? 8 : 4;
    cl_platform_id platform;
    cl_device_id device;
    cl_int error;
    check(clGetPlatformIDs(1, &platform, NULL), "platforms");
    check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, NULL), "devices");
    cl_context context = clCreateContext(NULL, 1, &device, NULL, NULL, &error);
    check(error, "context");
    cl_command_queue queue = clCreateCommandQueue(context, device, 0, &error);
    check(error, "queue");
    char define[32];
    snprintf(define, sizeof define, "\n#define NUMBER %s", arguments[5]);
    const char *parts[] = {text, define, KERNEL};
    cl_program program = clCreateProgramWithSource(context, 3, parts, NULL, &error);
    check(error, "program");
    const char *exact = width == 4 ? "-cl-fp32-correctly-rounded-divide-sqrt" : "", *flags = getenv("CLFLAGS");
    char options[1000];
    snprintf(options, sizeof options, "-cl-std=CL1.2 %s %s", exact, flags ? flags : "");
    if (clBuildProgram(program, 1, &device, options, NULL, NULL) != CL_SUCCESS) {
        static char said[100000];
        clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, sizeof said, said, NULL);
        fprintf(stderr, "%s\n", said);
        return 1;
    }
    cl_kernel kernel = clCreateKernel(program, "judge", &error);
    check(error, "kernel");
    char *results = calloc(all, 190 * width);
    cl_uint *statuses = calloc(all, 16);
    cl_mem from = clCreateBuffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, size, points, &error);
    check(error, "points");
    cl_mem to = clCreateBuffer(context, CL_MEM_WRITE_ONLY, all * 190 * width, NULL, &error);
    check(error, "results");
    cl_mem states = clCreateBuffer(context, CL_MEM_WRITE_ONLY, all * 16, NULL, &error);
    check(error, "statuses");
    check(clSetKernelArg(kernel, 0, sizeof from, &from), "argument 0");
    check(clSetKernelArg(kernel, 1, sizeof to, &to), "argument 1");
    check(clSetKernelArg(kernel, 2, sizeof states, &states), "argument 2");
    check(clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &all, NULL, 0, NULL, NULL), "kernel");
    check(clEnqueueReadBuffer(queue, to, CL_TRUE, 0, all * 190 * width, results, 0, NULL, NULL), "results");
    check(clEnqueueReadBuffer(queue, states, CL_TRUE, 0, all * 16, statuses, 0, NULL, NULL), "statuses");
    FILE *file = fopen(arguments[3], "wb");
    if (!file) return perror(arguments[3]), 1;
    const size_t counts[] = {1, 9, 90, 90};
    for (size_t point = 0; point < all; point++) {
        const char *at = results + point * 190 * width;
        for (size_t k = 0; k < 4; at += counts[k++] * width) {
            fwrite(at, width, counts[k], file);
            fwrite(statuses + 4 * point + k, 4, 1, file);
        }
    }
    return fclose(file);
}
