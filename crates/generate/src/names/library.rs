//! Names of the C library, which no top-level namespace may have.
//!
//! In: an identifier. Out: whether a standard header of C or POSIX declares it globally. LIMIT: variants for other
//! types (`sinf`, `strtod_l`) and long names that belong to one header are left out.

const GLOBAL: &str = "a64l abort abs access acct acos acosh alarm alloca asctime asin asinh asprintf atan atan2 atanh atexit \
    atof atoi atol atoll basename bcmp bcopy brk bsearch btowc bzero calloc cbrt ceil chdir chmod chown chroot clearenv \
    clearerr clock clone close confstr copysign cos cosh creat crypt ctermid ctime daemon difftime dirname div dprintf \
    drand48 drem dup dup2 dup3 ecvt endl environ erand48 erf erfc execl execle execlp execv execve execvp exit exp exp10 \
    exp2 expm1 fabs fchdir fchmod fchown fclose fcntl fcvt fdatasync fdim fdopen feof ferror fexecve fflush ffs fgetc \
    fgetpos fgets fileno finite floor flock fma fmax fmin fmod fopen fork fprintf fputc fputs fread free freopen frexp \
    fscanf fseek fstat fsync ftell ftok ftruncate fwrite gamma gcvt getc getchar getcwd getdate getdelim getenv getgid \
    getgroups getline getlogin getopt getpass getpid getppid getpt getsid getuid getw getwd gmtime gsignal hypot ilogb \
    index initstate isalnum isalpha isascii isatty isblank iscntrl isdigit isgraph islower isprint ispunct isspace \
    isupper isxdigit j0 j1 jn jrand48 kill killpg labs lchown ldexp ldiv lgamma link llabs lldiv llrint llround \
    localeconv localtime lockf log log10 log1p log2 logb longjmp lrand48 lrint lround lseek lstat malloc mblen mbrlen \
    mbtowc memchr memcmp memcpy memmem memmove memset mkdir mkfifo mknod mktemp mktime mmap modf mount mrand48 munmap \
    nan nanosleep nearbyint nextafter nice open openat pause pclose perror pipe poll popen pow pread printf profil \
    psignal ptrace putc putchar putenv puts putw pwrite qsort raise rand random read readlink readv realloc realpath \
    recv remainder remove remquo rename rewind rindex rint rmdir round sbrk scalb scalbn scanf seed48 select send \
    setbuf setenv setgid setjmp setlocale setsid setstate setuid setvbuf shutdown sigaction siglongjmp signal \
    significand sigpause sigset sigwait sin sincos sinh sleep snprintf socket sprintf sqrt srand srand48 srandom sscanf \
    stat strcat strchr strcmp strcpy strdup strlen strncat strncmp strncpy strstr strtod strtok strtol swab symlink \
    sync syscall sysconf system tan tanh tempnam tgamma time times tmpfile tmpnam toascii tolower toupper trunc truncate \
    ttyname tzset ualarm umask umount ungetc unlink unshare usleep utime valloc vfork vprintf wait waitpid write writev \
    y0 y1 yn daylight timezone tzname signgam optarg optind opterr \
    div_t ldiv_t time_t clock_t size_t ssize_t pid_t uid_t gid_t mode_t off_t key_t int8_t int16_t int32_t int64_t \
    uint8_t uint16_t uint32_t uint64_t intptr_t uintptr_t ptrdiff_t wint_t uint ushort ulong timespec timeval tm";

/// Whether the name is taken.
pub(crate) fn has(name: &str) -> bool {
    GLOBAL.split_whitespace().any(|global| global == name)
}
