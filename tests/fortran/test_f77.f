C     THE FORTRAN 77 INTERFACE: BITS OF THE C INTERFACE, TEXTS, AND EVERY
C     WRONG USE. THE PROGRAM IS BUILT TO STOP AT A NAN OR AN OVERFLOW OF
C     ITS OWN.
      PROGRAM TF77
      INTEGER NPASS, NFAIL
      COMMON /TALLY/ NPASS, NFAIL
      NPASS = 0
      NFAIL = 0
      CALL TRUN
      CALL TTEXT
      CALL TTRACE
      CALL TCASES
      CALL TSTEP
      CALL TMODEL
      CALL TWRONG
      CALL TDECK
      WRITE (*, *) NPASS, ' passed,', NFAIL, ' failed'
      IF (NFAIL .GT. 0 .OR. NPASS .LT. 400) STOP 1
      END

      SUBROUTINE CHECK(WHAT, TRUE)
      CHARACTER*(*) WHAT
      LOGICAL TRUE
      INTEGER NPASS, NFAIL
      COMMON /TALLY/ NPASS, NFAIL
      IF (TRUE) THEN
         NPASS = NPASS + 1
      ELSE
         NFAIL = NFAIL + 1
         WRITE (*, *) 'WRONG: ', WHAT
      END IF
      END

C     THE CALL SUCCEEDED, OR ITS MESSAGE IS SHOWN.
      SUBROUTINE GOOD(WHAT, IV, IERR)
      CHARACTER*(*) WHAT
      CHARACTER*200 TEXT
      INTEGER IV, IERR, JERR
      IF (IERR .NE. 0) THEN
         CALL RV_MSG(IV, TEXT, JERR)
         WRITE (*, *) TEXT
      END IF
      CALL CHECK(WHAT, IERR .EQ. 0)
      END

C     THE CALL ENDED WITH THIS CODE, AND ITS MESSAGE HOLDS THIS PART.
      SUBROUTINE FAILS(PART, IV, IERR, ICODE)
      CHARACTER*(*) PART
      CHARACTER*400 TEXT
      INTEGER IV, IERR, ICODE, JERR
      CALL RV_MSG(IV, TEXT, JERR)
      IF (IERR .NE. ICODE .OR. INDEX(TEXT, PART) .EQ. 0) THEN
         WRITE (*, *) IERR, ' ', TEXT
      END IF
      CALL CHECK(PART, IERR .EQ. ICODE .AND. INDEX(TEXT, PART) .GT. 0)
      END

C     WHOLE CASES, SEVERAL VALVES OPEN AT ONCE.
      SUBROUTINE TRUN
      INTEGER IV(40), IERR, I, ISTAT
      DOUBLE PRECISION GAP, X, Y, XC, YC
      DO 10 I = 1, 40
         CALL RV_NEW(IV(I), IERR)
         CALL GOOD('NEW', IV(I), IERR)
         CALL RV_SET(IV(I), 'film.gap_mm', 0.03D0 + 0.01D0*I, IERR)
   10 CONTINUE
      DO 20 I = 1, 40
         CALL CHECK('POSITIVE', IV(I) .GT. 0)
         IF (I .GT. 1) CALL CHECK('ANOTHER', IV(I) .NE. IV(I - 1))
         CALL RV_GET(IV(I), 'FILM.GAP_MM  ', X, IERR)
         CALL CHECK('OWN GAP', X .EQ. 0.03D0 + 0.01D0*I)
   20 CONTINUE
      DO 30 I = 1, 2
         GAP = 0.03D0 + 0.01D0*I
         CALL RV_RUN(IV(I), IERR)
         CALL GOOD('RUN', IV(I), IERR)
         CALL RV_MEAS(IV(I), 'closing_ms', X, IERR)
         CALL GOOD('MEAS', IV(I), IERR)
         CALL RV_FACT(IV(I), 'wet_frequency_hz ', Y, IERR)
         CALL GOOD('FACT', IV(I), IERR)
         CALL RV_STAT(IV(I), ISTAT, IERR)
         CALL GOOD('STAT', IV(I), IERR)
         CALL CHECK('ENDED WELL', ISTAT .EQ. 0)
         CALL PEER_RUN(GAP, XC, YC, IERR)
         CALL CHECK('PEER', IERR .EQ. 0)
         CALL CHECK('SAME BITS', X .EQ. XC .AND. Y .EQ. YC)
   30 CONTINUE
      DO 40 I = 1, 40
         CALL RV_FREE(IV(I), IERR)
         CALL GOOD('FREE', IV(I), IERR)
         CALL CHECK('NO VALVE LEFT', IV(I) .EQ. 0)
   40 CONTINUE
      CALL RV_FREE(IV(1), IERR)
      CALL CHECK('FREE OF NONE', IERR .EQ. 0)
      END

C     PADDED, CUT, AND ASSUMED LENGTHS.
      SUBROUTINE TTEXT
      CHARACTER*60 LONG
      CHARACTER*3 SHORT
      CHARACTER*24 NAME
      CHARACTER*8 UNIT
      INTEGER IV, IERR
      CALL RV_NEW(IV, IERR)
      LONG = 'run.model'
      CALL RV_SETC(IV, LONG, 'film_table      ', IERR)
      CALL GOOD('SETC', IV, IERR)
      CALL RV_GETC(IV, LONG, SHORT, IERR)
      CALL CHECK('CUT', SHORT .EQ. 'fil')
      CALL RV_GETC(IV, 'run.model', LONG, IERR)
      CALL CHECK('PADDED', LONG .EQ. 'film_table')
      CALL RV_SETC(IV, 'run.title', ' A TITLE', IERR)
      CALL RV_GETC(IV, 'run.title', LONG, IERR)
      CALL CHECK('BLANKS BEFORE', LONG .EQ. ' A TITLE')
      CALL RV_SETC(IV, 'run.title', '   ', IERR)
      CALL RV_GETC(IV, 'run.title', LONG, IERR)
      CALL CHECK('EMPTY', IERR .EQ. 0 .AND. LONG .EQ. ' ')
      CALL RV_GETC(IV, 'run.titel', LONG, IERR)
      CALL CHECK('BLANK AFTER FAILURE', LONG .EQ. ' ')
      CALL FAILS('did you mean ''run.title''?', IV, IERR, 1)
      CALL RV_MSG(IV, SHORT, IERR)
      CALL CHECK('CUT MESSAGE', IERR .EQ. 0 .AND. SHORT .EQ. '''ru')
      CALL RV_NAME('KEYS', 4, NAME, UNIT, IERR)
      CALL CHECK('KEY', NAME .EQ. 'run.t_end_ms' .AND. UNIT .EQ. 'ms')
      CALL RV_NAME('measures', 6, NAME, UNIT, IERR)
      CALL CHECK('MEASURE', NAME .EQ. 'closing_ms' .AND. UNIT .EQ. 'ms')
      CALL RV_NAME('facts', 8, NAME, UNIT, IERR)
      CALL CHECK('FACT', NAME .EQ. 'solver_method')
      CALL RV_NAME('traces', 9, NAME, UNIT, IERR)
      CALL CHECK('TRACE', NAME .EQ. 'leakage_mm3_ms' .AND. IERR .EQ. 0)
      CALL RV_NAME('traces', 11, NAME, UNIT, IERR)
      CALL CHECK('NO TRACE', NAME .EQ. ' ' .AND. IERR .EQ. 1)
      CALL RV_NAME('keys', 0, NAME, UNIT, IERR)
      CALL CHECK('FROM 1', NAME .EQ. ' ' .AND. IERR .EQ. 1)
      CALL RV_NAME('x', 1, NAME, UNIT, IERR)
      CALL CHECK('NO LIST', NAME .EQ. ' ' .AND. IERR .EQ. 1)
      CALL RV_NAME('meters', 1, NAME, UNIT, IERR)
      CALL CHECK('NO SUCH LIST', NAME .EQ. ' ' .AND. IERR .EQ. 1)
      CALL RV_VERS(SHORT, IERR)
      CALL CHECK('VERSION', IERR .EQ. 0 .AND. INDEX(SHORT, '.') .EQ. 2)
      CALL RV_FREE(IV, IERR)
      END

      SUBROUTINE TTRACE
      INTEGER IV, IERR, N, I
      DOUBLE PRECISION T(50), X(50)
      CALL RV_NEW(IV, IERR)
      CALL RV_SETC(IV, 'run.traces', '.true.', IERR)
      CALL RV_SET(IV, 'run.t_end_ms', 2D0, IERR)
      CALL RV_SET(IV, 'run.trace_dt_ms', 0.05D0, IERR)
      CALL RV_RUN(IV, IERR)
      CALL GOOD('RUN', IV, IERR)
      CALL RV_NTRC(IV, N, IERR)
      CALL CHECK('SAMPLES', IERR .EQ. 0 .AND. N .EQ. 41)
      CALL RV_TIME(IV, T, N, IERR)
      CALL GOOD('TIME', IV, IERR)
      CALL CHECK('LAST TIME', ABS(T(41) - 2D-3) .LT. 1D-15)
      CALL RV_TRC(IV, 3, X, N, IERR)
      CALL GOOD('TRC', IV, IERR)
      CALL CHECK('INLET', ABS(X(41) - 20D0) .LT. 1D-12)
      CALL RV_TRC(IV, 0, X, N, IERR)
      CALL FAILS('no such trace', IV, IERR, 1)
      CALL RV_TRC(IV, 6, X, N, IERR)
      CALL FAILS('no such trace', IV, IERR, 1)
      DO 10 I = -1, 42, 43
         CALL RV_TRC(IV, 1, X, I, IERR)
         CALL FAILS('41 elements', IV, IERR, 1)
         CALL RV_TIME(IV, X, I, IERR)
         CALL FAILS('41 elements', IV, IERR, 1)
   10 CONTINUE
      CALL RV_FREE(IV, IERR)
      END

      SUBROUTINE TCASES
      INTEGER NC, NM
      PARAMETER (NC = 600, NM = 9)
      INTEGER IV, IERR, I, J, ISTAT(NC), JSTAT(NC)
      DOUBLE PRECISION X(2, NC), Y(NM, NC), YC(NM, NC)
      CHARACTER*20 KEY(2)
      LOGICAL SAME
      DATA KEY /'film.gap_mm', 'pressure.inlet_kpa'/
      DO 10 I = 1, NC
         X(1, I) = 0.03D0 + 1D-4*I
         X(2, I) = 10D0 + MOD(I, 7)
   10 CONTINUE
      CALL RV_NEW(IV, IERR)
      CALL RV_CASES(IV, 2, KEY, NC, X, NM, Y, ISTAT, 2, IERR)
      CALL GOOD('CASES', IV, IERR)
      CALL PEER_SWEEP(NC, X, YC, JSTAT, IERR)
      SAME = IERR .EQ. 0
      DO 30 I = 1, NC
         SAME = SAME .AND. ISTAT(I) .EQ. JSTAT(I)
         DO 20 J = 1, NM
            SAME = SAME .AND. (Y(J, I) .EQ. YC(J, I) .OR.
     &         Y(J, I) .NE. Y(J, I) .AND. YC(J, I) .NE. YC(J, I))
   20    CONTINUE
   30 CONTINUE
      CALL CHECK('SAME BITS', SAME .AND. Y(6, 1) .GT. 0D0)
      CALL RV_CASES(IV, 0, KEY, NC, X, NM, Y, ISTAT, 0, IERR)
      CALL FAILS('1 to 64 keys', IV, IERR, 1)
      CALL RV_CASES(IV, 65, KEY, NC, X, NM, Y, ISTAT, 0, IERR)
      CALL FAILS('1 to 64 keys', IV, IERR, 1)
      CALL RV_CASES(IV, 2, KEY, -1, X, NM, Y, ISTAT, 0, IERR)
      CALL FAILS('cases', IV, IERR, 1)
      CALL RV_CASES(IV, 2, KEY, NC, X, NM + 1, Y, ISTAT, 0, IERR)
      CALL FAILS('9, not 10', IV, IERR, 1)
      CALL RV_CASES(IV, 2, KEY, NC, X, NM, Y, ISTAT, -1, IERR)
      CALL FAILS('threads', IV, IERR, 1)
      KEY(2) = 'film.gap'
      CALL RV_CASES(IV, 2, KEY, NC, X, NM, Y, ISTAT, 0, IERR)
      CALL FAILS('did you mean ''film.gap_mm''?', IV, IERR, 1)
      CALL RV_FREE(IV, IERR)
      END

C     STEPPING, AND THE STATE IN A DOUBLE PRECISION ARRAY.
      SUBROUTINE TSTEP
      INTEGER IV, IERR, K, I, N, ND
      DOUBLE PRECISION T, Q(1), V(1), H, OUT(5), AGAIN, X, W(40), GAP
      LOGICAL SAME
      GAP = 0.04D0
      CALL RV_NEW(IV, IERR)
      CALL RV_SET(IV, 'film.gap_mm', GAP, IERR)
      CALL RV_STEP(IV, 1D-3, 0D0, 0D0, 0D0, 0D0, IERR)
      CALL FAILS('begin first', IV, IERR, 1)
      CALL RV_SIZE(IV, N, IERR)
      CALL CHECK('NO SIZE', N .EQ. 0 .AND. IERR .EQ. 1)
      CALL RV_BEGIN(IV, 0D0, IERR)
      CALL GOOD('BEGIN', IV, IERR)
      CALL RV_SIZE(IV, N, IERR)
      CALL CHECK('SIZE', N .GT. 5 .AND. N .LE. 40 .AND. IERR .EQ. 0)
      DO 10 K = 0, 39
         IF (K .EQ. 20) CALL RV_SAVE(IV, W, N, IERR)
         CALL RV_STEP(IV, 50D-6*(K + 1), 500D0*K, 500D0*(K + 1), 0D0,
     &      0D0, IERR)
         CALL GOOD('STEP', IV, IERR)
   10 CONTINUE
      CALL PEER_STEP(GAP, 40, OUT, IERR)
      SAME = IERR .EQ. 0
      DO 20 I = 1, 5
         CALL RV_OUT(IV, I, X, IERR)
         SAME = SAME .AND. IERR .EQ. 0 .AND. X .EQ. OUT(I)
   20 CONTINUE
      CALL CHECK('SAME BITS', SAME .AND. OUT(1) .GT. 0D0)
      CALL RV_REST(IV, W, N, IERR)
      CALL GOOD('REST', IV, IERR)
      CALL RV_NDOF(IV, ND, IERR)
      CALL CHECK('DOFS', ND .EQ. 1 .AND. IERR .EQ. 0)
      CALL RV_STATE(IV, T, Q, V, ND, H, IERR)
      CALL CHECK('STATE', T .EQ. 1D-3 .AND. Q(1) .GT. 0D0 .AND.
     &   V(1) .NE. 0D0 .AND. H .GT. 0D0 .AND. IERR .EQ. 0)
      DO 30 K = 20, 39
         CALL RV_STEP(IV, 50D-6*(K + 1), 500D0*K, 500D0*(K + 1), 0D0,
     &      0D0, IERR)
   30 CONTINUE
      CALL RV_OUT(IV, 1, AGAIN, IERR)
      CALL CHECK('SAME AFTER REST', AGAIN .EQ. OUT(1))
      CALL RV_STATE(IV, T, Q, V, 2, H, IERR)
      CALL FAILS('1 degrees of freedom, not 2', IV, IERR, 1)
      CALL RV_OUT(IV, 0, X, IERR)
      CALL FAILS('no such output', IV, IERR, 1)
      CALL RV_OUT(IV, 11, X, IERR)
      CALL FAILS('no such output', IV, IERR, 1)
      CALL RV_OUT(IV, 9, X, IERR)
      CALL CHECK('NO LEAKAGE', IERR .EQ. 0 .AND. X .NE. X)
      CALL RV_STEP(IV, 1D-3, 0D0, 0D0, 0D0, 0D0, IERR)
      CALL FAILS('time must go on', IV, IERR, 1)
      CALL RV_STEP(IV, 3D-3, X, 0D0, 0D0, 0D0, IERR)
      CALL FAILS('finite', IV, IERR, 1)
      CALL RV_SAVE(IV, W, N - 1, IERR)
      CALL FAILS('numbers of 8', IV, IERR, 1)
      CALL RV_SAVE(IV, W, -1, IERR)
      CALL FAILS('numbers of 8', IV, IERR, 1)
      CALL RV_REST(IV, W, N + 1, IERR)
      CALL FAILS('numbers of 8', IV, IERR, 1)
      W(3) = W(3) + 1D0
      CALL RV_REST(IV, W, N, IERR)
      CALL FAILS('damaged', IV, IERR, 1)
      CALL RV_STEP(IV, 1D0, 0D0, 1D300, 0D0, 0D0, IERR)
      CALL CHECK('NO SOLVER FOLLOWS', IERR .GE. 3)
      CALL RV_STEP(IV, 2D0, 0D0, 0D0, 0D0, 0D0, IERR)
      CALL FAILS('the last step failed', IV, IERR, 1)
      CALL RV_FREE(IV, IERR)
      END

C     EACH MODEL AND METHOD MAKES OVERFLOWS AND NANS OF ITS OWN.
      SUBROUTINE TMODEL
      INTEGER IV, IERR, I, J, K
      DOUBLE PRECISION T
      CHARACTER*11 MODEL(4)
      CHARACTER*8 METHOD(2)
      DATA MODEL /'traditional', 'squeeze', 'film', 'film_table'/
      DATA METHOD /'implicit', 'explicit'/
      DO 30 I = 1, 4
         DO 20 J = 1, 2
            CALL RV_NEW(IV, IERR)
            CALL RV_SETC(IV, 'run.model', MODEL(I), IERR)
            CALL RV_SETC(IV, 'solver.method', METHOD(J), IERR)
            CALL RV_SET(IV, 'film.modes', 1D0, IERR)
            CALL RV_SET(IV, 'run.t_end_ms', 3D0, IERR)
            CALL RV_RUN(IV, IERR)
            CALL GOOD(MODEL(I), IV, IERR)
            CALL RV_BEGIN(IV, 0D0, IERR)
            DO 10 K = 1, 3
               T = 1D-4*K
               CALL RV_STEP(IV, T, 0D0, 1D4, 0D0, 0D0, IERR)
               CALL GOOD(METHOD(J), IV, IERR)
   10       CONTINUE
            CALL RV_STEP(IV, 1D0, 0D0, 1D300, 0D0, 0D0, IERR)
            CALL CHECK('NO SOLVER FOLLOWS', IERR .GE. 3)
            CALL RV_FREE(IV, IERR)
   20    CONTINUE
   30 CONTINUE
      END

C     NUMBERS THAT ARE NO VALVE, IN EVERY ROUTINE; AND WRONG SETTINGS.
      SUBROUTINE TWRONG
      INTEGER IV, JV, IERR, I, N, IBAD(4), K(1)
      DOUBLE PRECISION X, Y(9, 1), W(1, 40)
      CHARACTER*200 TEXT
      CALL RV_NEW(IV, IERR)
      JV = IV
      CALL RV_FREE(IV, IERR)
      CALL RV_NEW(IV, IERR)
      CALL CHECK('SAME PLACE, ANOTHER NUMBER', IV .NE. JV)
      IBAD(1) = 0
      IBAD(2) = -1
      IBAD(3) = JV
      IBAD(4) = 2147483647
      DO 10 I = 1, 4
         CALL RV_SET(IBAD(I), 'film.gap_mm', 1D0, IERR)
         CALL FAILS('was closed', IBAD(I), IERR, 1)
         CALL RV_SETC(IBAD(I), 'run.model', 'film', IERR)
         CALL CHECK('SETC', IERR .EQ. 1)
         CALL RV_GET(IBAD(I), 'film.gap_mm', X, IERR)
         CALL CHECK('GET', IERR .EQ. 1)
         CALL RV_GETC(IBAD(I), 'run.model', TEXT, IERR)
         CALL CHECK('GETC', IERR .EQ. 1 .AND. TEXT .EQ. ' ')
         CALL RV_RUN(IBAD(I), IERR)
         CALL CHECK('RUN', IERR .EQ. 1)
         CALL RV_STAT(IBAD(I), N, IERR)
         CALL CHECK('STAT', IERR .EQ. 1)
         CALL RV_MEAS(IBAD(I), 'fall_ms', X, IERR)
         CALL CHECK('MEAS', IERR .EQ. 1)
         CALL RV_FACT(IBAD(I), 'reynolds', X, IERR)
         CALL CHECK('FACT', IERR .EQ. 1)
         CALL RV_NTRC(IBAD(I), N, IERR)
         CALL CHECK('NTRC', IERR .EQ. 1 .AND. N .EQ. 0)
         CALL RV_TIME(IBAD(I), W, 40, IERR)
         CALL CHECK('TIME', IERR .EQ. 1)
         CALL RV_TRC(IBAD(I), 1, W, 40, IERR)
         CALL CHECK('TRC', IERR .EQ. 1)
         CALL RV_CASES(IBAD(I), 1, 'film.gap_mm', 1, W, 9, Y, K, 1,
     &      IERR)
         CALL CHECK('CASES', IERR .EQ. 1)
         CALL RV_BEGIN(IBAD(I), 0D0, IERR)
         CALL CHECK('BEGIN', IERR .EQ. 1)
         CALL RV_STEP(IBAD(I), 1D-3, 0D0, 0D0, 0D0, 0D0, IERR)
         CALL CHECK('STEP', IERR .EQ. 1)
         CALL RV_OUT(IBAD(I), 1, X, IERR)
         CALL CHECK('OUT', IERR .EQ. 1)
         CALL RV_NDOF(IBAD(I), N, IERR)
         CALL CHECK('NDOF', IERR .EQ. 1)
         CALL RV_STATE(IBAD(I), X, W, W, 1, X, IERR)
         CALL CHECK('STATE', IERR .EQ. 1)
         CALL RV_SIZE(IBAD(I), N, IERR)
         CALL CHECK('SIZE', IERR .EQ. 1)
         CALL RV_SAVE(IBAD(I), W, 40, IERR)
         CALL CHECK('SAVE', IERR .EQ. 1)
         CALL RV_REST(IBAD(I), W, 40, IERR)
         CALL CHECK('REST', IERR .EQ. 1)
   10 CONTINUE
      CALL RV_FREE(JV, IERR)
      CALL CHECK('FREE OF A CLOSED ONE', IERR .EQ. 1 .AND. JV .EQ. 0)
      CALL RV_GET(IV, 'pressure.event_ms', X, IERR)
      CALL CHECK('NOT A NUMBER', X .NE. X)
      CALL RV_SET(IV, 'film.gap_mm', X, IERR)
      CALL FAILS('NaN and infinity', IV, IERR, 1)
      CALL RV_SET(IV, 'film.gap_mm', -0.05D0, IERR)
      CALL FAILS('must be >= 0 (mm)', IV, IERR, 1)
      CALL RV_SET(IV, 'pressure.file', 1D0, IERR)
      CALL FAILS('as text', IV, IERR, 1)
      CALL RV_MEAS(IV, 'fall_ms', X, IERR)
      CALL FAILS('run the valve first', IV, IERR, 1)
      CALL RV_RUN(IV, IERR)
      CALL GOOD('RUN', IV, IERR)
      CALL RV_MEAS(IV, 'fall_s', X, IERR)
      CALL FAILS('no such name', IV, IERR, 1)
      CALL RV_SET(IV, 'film.gap_mm', 0D0, IERR)
      CALL RV_RUN(IV, IERR)
      CALL FAILS('the gap is 0', IV, IERR, 4)
      CALL RV_STAT(IV, N, IERR)
      CALL CHECK('FILM CLOSED', IERR .EQ. 0 .AND. N .EQ. 2)
      CALL RV_FREE(IV, IERR)
      END

      SUBROUTINE TDECK
      INTEGER IV, IERR
      DOUBLE PRECISION X
      CHARACTER*400 TEXT
      OPEN (10, FILE='f77.nml')
      WRITE (10, '(A)') '&film gap_mm = 0.04 /'
      CLOSE (10)
      CALL RV_DECK('f77.nml', IV, TEXT, IERR)
      CALL CHECK('DECK', IERR .EQ. 0 .AND. TEXT .EQ. ' ')
      CALL RV_GET(IV, 'film.gap_mm', X, IERR)
      CALL CHECK('GAP OF THE DECK', X .EQ. 0.04D0)
      CALL RV_FREE(IV, IERR)
      CALL RV_DECK('THERE IS NONE', IV, TEXT, IERR)
      CALL CHECK('NO DECK', IERR .EQ. 2 .AND. IV .EQ. 0)
      CALL CHECK('ITS NAME', INDEX(TEXT, 'THERE IS NONE') .GT. 0)
      CALL RV_DECK(' ', IV, TEXT, IERR)
      CALL CHECK('NO NAME', IERR .EQ. 2 .AND. TEXT(:3) .EQ. ''''':')
      END
