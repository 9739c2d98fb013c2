/* python.exe: the interpreter of python311.dll, with the arguments of the command line. */
#include <windows.h>

int wmain(int count, wchar_t **words)
{
    HMODULE library = LoadLibraryW(L"python311.dll");
    int (*main_of_python)(int, wchar_t **);

    if (!library)
        return 111;
    main_of_python = (int (*)(int, wchar_t **))GetProcAddress(library, "Py_Main");
    return main_of_python(count, words);
}
