// The program around Python's library, for which no C library is asked.

typedef unsigned short wide;

__declspec(dllimport) wide *GetCommandLineW(void);
__declspec(dllimport) wide **CommandLineToArgvW(const wide *line, int *count);
__declspec(dllimport) _Noreturn void ExitProcess(unsigned int code);
__declspec(dllimport) int Py_Main(int count, wide **arguments);

void start(void) {
    int count;
    wide **arguments = CommandLineToArgvW(GetCommandLineW(), &count);
    ExitProcess((unsigned int)Py_Main(count, arguments));
}
