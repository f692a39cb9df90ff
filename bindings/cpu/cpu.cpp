// pivot_core._cpu: which x86-64 level this machine runs. Compiled for the oldest CPU, so it imports everywhere.
#define PY_SSIZE_T_CLEAN
#include <Python.h>

namespace {

PyObject* level(PyObject* /*self*/, PyObject* /*args*/) {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("x86-64-v3")) return PyUnicode_FromString("v3");
    if (__builtin_cpu_supports("x86-64-v2")) return PyUnicode_FromString("v2");
    return PyUnicode_FromString("v1");
}

PyMethodDef methods[] = {{"level", level, METH_NOARGS, "The psABI level of this CPU: 'v1', 'v2' or 'v3'."},
                         {nullptr, nullptr, 0, nullptr}};

PyModuleDef module_def = {PyModuleDef_HEAD_INIT, "_cpu", nullptr, 0, methods, nullptr, nullptr, nullptr, nullptr};

}  // namespace

PyMODINIT_FUNC PyInit__cpu() { return PyModule_Create(&module_def); }
