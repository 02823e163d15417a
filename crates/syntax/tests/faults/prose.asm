This is not a model at all.
It is a text (of several lines), with "strings" and 12 numbers;
and it ends here.
