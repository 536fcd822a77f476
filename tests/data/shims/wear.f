c     Archard's law with a hardness that falls with the temperature, as
c     it stands in another solver's folder of user subroutines.
      subroutine uwearindex ( wrnd,n,nuser,inc,time,timinc,coord,i2or3,
     &                        normal,cofornd,frfornd,costrs,frstrs,
     &                        param,tempi,relvelnd,itouch,ibody1,
     &                        ibody2,fric)
      real*8 wrnd,time,timinc,coord,normal,cofornd
      real*8 frfornd,costrs,frstrs,param,tempi,relvelnd,fric
      real*8 hard
      integer n,nuser,inc,i2or3,itouch,ibody1,ibody2
      dimension coord(*),normal(*),param(*)
      hard = param(2)*exp(-param(3)*(tempi-293.0d0))
      if (costrs .gt. 0.0d0) then
        wrnd = (param(1)/hard)*costrs**1.25d0*relvelnd
      else
        wrnd = 0.0d0
      end if
      return
      end
